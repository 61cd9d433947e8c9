#include "asperity/profile/correlation_under_stretch.h"

#include <cmath>
#include <numbers>

namespace asperity {

namespace {

constexpr double kSmall = 1e-3;  // g(a) = 1 − a²/6 + …

// ∫₀¹ exp(−a²u²/2) du
double remaining_share(double a) {
  if (a < kSmall) return 1.0 - a * a / 6.0;
  return std::sqrt(0.5 * std::numbers::pi) * std::erf(a / std::numbers::sqrt2) / a;
}

}  // namespace

double correlation_under_stretch(std::span<const double> frequency_cycles_per_mm, std::span<const double> density,
                                 double length_sigma, double length_mm) {
  double power = 0.0, remaining = 0.0;
  for (std::size_t i = 1; i < density.size(); ++i) {
    const double step = 0.5 * (frequency_cycles_per_mm[i] - frequency_cycles_per_mm[i - 1]);
    for (const std::size_t j : {i - 1, i}) {
      power += step * density[j];
      remaining +=
          step * density[j] * remaining_share(std::numbers::pi * frequency_cycles_per_mm[j] * length_sigma * length_mm);
    }
  }
  return power > 0.0 ? remaining / power : 1.0;
}

}  // namespace asperity
