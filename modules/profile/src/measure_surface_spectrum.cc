#include "asperity/profile/measure_surface_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/signal/chi_square.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr double kSure = 1.959963985;
constexpr double kProbability = 0.95;
constexpr double kNeighbours = 1.0 / 36.0;  // squared correlation of Hann windows that overlap by half

// Ends of what a density may be whose estimate has so many degrees of freedom, over the estimate.
struct Factors {
  double low = 0.0, high = 0.0;
};

Factors chi_square_factors(double freedom) {
  return {freedom / chi_square_quantile(0.5 * (1.0 + kProbability), freedom),
          freedom / chi_square_quantile(0.5 * (1.0 - kProbability), freedom)};
}

}  // namespace

SurfaceSpectrum measure_surface_spectrum(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                                         const SpectrumConfig& config) {
  const PowerSpectrum measured = measure_spectrum(height_m, spacing_m, config);
  SurfaceSpectrum out;
  out.frequency_cycles_per_mm = measured.frequency;
  out.density_m2_mm = measured.density;
  out.segments = measured.segments;
  const std::size_t n = out.size();
  out.low_m2_mm.assign(n, kNan);
  out.high_m2_mm.assign(n, kNan);
  out.noise_m2_mm.assign(n, kNan);
  if (n == 0) return out;
  const auto K = static_cast<double>(measured.segments);
  out.freedom = 2.0 * K / (1.0 + 2.0 * (1.0 - 1.0 / K) * kNeighbours);
  if (noise.added_psd_m2_mm.empty() || !(noise.added_rms_m > 0.0)) return out;

  const Factors inner = chi_square_factors(out.freedom), ends = chi_square_factors(0.5 * out.freedom);
  const double relative = 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;  // of the power
  const double level = std::exp(kSure * std::sqrt(std::log1p(relative * relative)));
  const double contact = std::min(1.0, noise.contact_rms_m / noise.added_rms_m) / std::numbers::sqrt3;
  for (std::size_t k = 0; k < n; ++k) {
    const double m = measured.density[k];
    const double added =
        spectrum_at(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, out.frequency_cycles_per_mm[k]);
    const Factors& factors = k == 0 || k + 1 == n ? ends : inner;
    const double surface = std::max(0.0, m - added);
    const double both =
        kSure * std::hypot(2.0 * noise.scale_sigma * surface, 2.0 * contact * std::sqrt(surface * added));
    out.noise_m2_mm[k] = added;
    out.density_m2_mm[k] = surface;
    out.low_m2_mm[k] = std::max(0.0, m - added - std::hypot(m * (1.0 - factors.low), added * (level - 1.0), both));
    out.high_m2_mm[k] =
        std::max(0.0, m - added + std::hypot(m * (factors.high - 1.0), added * (1.0 - 1.0 / level), both));
  }
  return out;
}

}  // namespace asperity
