#include "fourier_tables.h"

#include <cmath>
#include <numbers>

namespace asperity {

SeriesSize size_of(const Fourier1d& f) {
  SeriesSize size;
  const double omega_per_m = 2.0 * std::numbers::pi / (1e-3 * f.length_mm);
  double power = 0.0;
  double slope_power = 0.0;
  size.mean = f.mean_m;
  size.most_m = std::abs(f.mean_m);
  for (std::size_t j = 0; j < f.a_m.size(); ++j) {
    const double k = omega_per_m * static_cast<double>(j + 1);
    const double amplitude = std::hypot(f.a_m[j], f.b_m[j]);
    power += 0.5 * amplitude * amplitude;
    slope_power += 0.5 * k * amplitude * k * amplitude;
    size.most_m += amplitude;
    size.most_slope += k * amplitude;
  }
  size.rms_m = std::sqrt(power);
  size.rms_slope = std::sqrt(slope_power);
  return size;
}

}  // namespace asperity
