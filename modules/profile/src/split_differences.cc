#include "split_differences.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace asperity {

namespace {

constexpr int kScales = 53;  // in equal ratios of 6 %
constexpr double kLeastScale = 0.1, kMostScale = 2.0;
constexpr int kDistances = 61;
constexpr double kFarthest_mm = 0.6;

}  // namespace

SplitDifferences split_differences(std::span<const double> frequency, std::span<const double> difference,
                                   std::span<const double> noise, std::span<const double> surface) {
  SplitDifferences out;
  double best = std::numeric_limits<double>::infinity();
  const double step = frequency.size() > 1 ? frequency[1] - frequency[0] : 0.0;
  for (int k = 0; k < kDistances; ++k) {
    const double apart_mm = kFarthest_mm * k / (kDistances - 1);
    std::vector<double> lines(frequency.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
      lines[i] = surface[i] * (1.0 - std::cyl_bessel_j(0.0, 2.0 * std::numbers::pi * frequency[i] * apart_mm));
    for (int j = 0; j < kScales; ++j) {
      const double scale = kLeastScale * std::pow(kMostScale / kLeastScale, static_cast<double>(j) / (kScales - 1));
      double cost = 0.0, noise_m2 = 0.0, lines_m2 = 0.0;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        const double model = scale * noise[i] + lines[i];
        if (!(model > 0.0)) continue;
        cost += std::log(model) + difference[i] / model;
        noise_m2 += step * scale * noise[i];
        lines_m2 += step * lines[i];
      }
      if (!(cost < best)) continue;
      best = cost;
      out = {scale, 1e-3 * apart_mm, noise_m2, lines_m2};
    }
  }
  return out;
}

}  // namespace asperity
