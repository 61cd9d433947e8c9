#include "measure_depth_under_noise.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/signal/statistics.h"
#include "draw_noise.h"
#include "period_depths.h"
#include "root_of_power.h"

namespace asperity {

namespace {

constexpr std::size_t kDepthDraws = 16;
constexpr std::uint64_t kDepthSeed = 20'260'102;

// The standard error of the median over the periods, as far as unlike periods show it.
double depth_scatter_m(std::span<const double> height_m, double period) {
  const std::vector<double> depths = period_depths(height_m, period);
  if (depths.empty()) return kNan;
  return std::sqrt(0.5 * std::numbers::pi / static_cast<double>(depths.size())) * kSigmaPerMad *
         median_absolute_deviation(depths);
}

double usual_depth_m(std::span<const double> height_m, double period) {
  const std::vector<double> depths = period_depths(height_m, period);
  return depths.empty() ? kNan : median(depths);
}

double root_mean_square(std::span<const double> x) {
  double sum = 0.0, count = 0.0;
  for (const double v : x) {
    if (!std::isfinite(v)) continue;
    sum += v * v;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : kNan;
}

}  // namespace

void measure_depth_under_noise(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                               Periodicity& out) {
  out.depth_m = usual_depth_m(height_m, out.pitch_m / spacing_m);
  if (!std::isfinite(out.depth_m)) return;

  const double period = out.pitch_m / spacing_m;
  Random random(kDepthSeed);
  std::vector<double> heavier(height_m.size());
  std::array<std::vector<double>, 2> squares;
  for (std::size_t j = 0; j < kDepthDraws; ++j) {
    const std::vector<double> more =
        draw_noise(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, height_m.size(), 1e3 * spacing_m, random);
    for (std::size_t power = 1; power <= 2; ++power) {
      const double factor = std::sqrt(static_cast<double>(power));
      for (std::size_t i = 0; i < heavier.size(); ++i) heavier[i] = height_m[i] + factor * more[i];
      const double depth_m = usual_depth_m(heavier, period);
      if (!std::isfinite(depth_m)) return;
      squares[power - 1].push_back(depth_m * depth_m);
    }
  }
  const double before_m = out.depth_m;
  const double none = before_m * before_m, with = mean(squares[0]), twice = mean(squares[1]);
  const double parabola = 3.0 * none - 3.0 * with + twice;
  const double relative = 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;
  // Of what noise adds to extremes the extrapolation finds about half: its curve is steepest where it cannot look.
  const double doubt_m2 = 0.5 * (parabola - none);
  // The draws know the noise that was found; what else there is, restored peaks and impacts, shows between the periods.
  const double scatter_m = depth_scatter_m(height_m, period);
  const double spread_m2 = std::max(standard_deviation(squares[0]), 2.0 * before_m * scatter_m);
  const double height =
      std::hypot(noise.scale_sigma, noise.contact_rms_m / std::numbers::sqrt3 / root_mean_square(height_m));
  const Root depth = root_of_power(parabola, std::hypot(std::hypot(spread_m2, doubt_m2),
                                                        std::hypot(relative * (parabola - none), 2.0 * height * none)));
  out.depth_m = depth.value;
  out.depth_stderr_m = depth.standard_error;
}

}  // namespace asperity
