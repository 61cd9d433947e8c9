#include "probability_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "asperity/signal/student.h"

namespace asperity {

std::optional<ProbabilityCurve> fit_probability_curve(const MaterialCurve& curve) {
  constexpr int kSteps = 600;
  constexpr double kMostSigmas = 3.0, kNormal = 1e20;
  constexpr double kSteeper = 1.5, kMostLeft = 0.01;
  const double count = static_cast<double>(curve.count());
  constexpr double kLeastHeights = 50.0;
  if (count < kLeastHeights) return std::nullopt;
  // The middle of the first sample is beyond it.
  const double reach = std::min(kMostSigmas, student_quantile(1.0 - 2.0 / count, kNormal));
  std::vector<double> at, height;
  for (int i = 0; i <= kSteps; ++i) {
    const double s = reach * (2.0 * i / kSteps - 1.0);
    at.push_back(s);
    height.push_back(curve.level(0.5 * std::erfc(-s / std::numbers::sqrt2)));
  }
  const std::size_t n = at.size();
  double mean = 0.0, variance = 0.0;
  for (const double h : height) mean += h / static_cast<double>(n);
  for (const double h : height) variance += (h - mean) * (h - mean);
  if (!(variance > 0.0)) return std::nullopt;
  // The line is 1 and s, whose sum is 0; the kink max(0, s − s_k) is made orthogonal to both. Sums over the points
  // behind the kink grow as it goes back.
  double squares = 0.0, products = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    height[i] -= mean;
    squares += at[i] * at[i];
    products += at[i] * height[i];
  }
  double best_left = variance;
  ProbabilityCurve best;
  constexpr std::size_t kEnds = 24;  // no line of fewer points
  double points = 0.0, s1 = 0.0, s2 = 0.0, h1 = 0.0, sh = 0.0;
  for (std::size_t k = n; k-- > kEnds;) {
    const double s = at[k];
    if (k + kEnds < n) {
      const double kink1 = s1 - points * s, kink_s = s2 - s * s1, kink2 = s2 - 2.0 * s * s1 + points * s * s;
      const double kink_h = sh - s * h1;
      const double own = kink2 - kink1 * kink1 / static_cast<double>(n) - kink_s * kink_s / squares;
      const double with = kink_h - kink_s * products / squares;
      const double left = variance - products * products / squares - with * with / own;
      if (left < best_left) {
        const double bend = with / own, slope = (products - bend * kink_s) / squares;
        best_left = left;
        best = {-slope, -(slope + bend), 0.5 * std::erfc(-s / std::numbers::sqrt2)};
      }
    }
    points += 1.0;
    s1 += s;
    s2 += s * s;
    h1 += height[k];
    sh += s * height[k];
  }
  if (!(best.plateau > 0.0) || best.pits < kSteeper * best.plateau || best_left > kMostLeft * variance)
    return std::nullopt;
  return best;
}

}  // namespace asperity
