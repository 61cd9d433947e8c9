#pragma once

#include <span>
#include <vector>

namespace asperity {

// A texture less the noise that is expected in it.
struct WienerTexture {
  std::vector<double> texture_m;      // the expected texture, given what was measured
  double error_rms_m = 0.0;           // of texture_m, expected
  double error_ratio = 0.0;           // of that to the measured texture's
  double expected_correlation = 0.0;  // of texture_m with the true texture
};

// Wiener's filter (N. Wiener, 1949) of a measured texture h + n, whose noise n has the known one-sided density
// S_n(k) (m²/(cycles/mm) at rising frequencies, `noise_psd_m2_mm`), the surface's density being estimated from the
// data themselves:
//
//   W(k) = max(0, 1 − S_n(k)/P(k)),   P the periodogram over ± 4 bins or ± k/16,
//   texture = W · measured,   error² = ∫ W S_n dk,   correlation² = ∫ W (P − S_n)₊ dk / ∫ (P − S_n)₊ dk.
//
// Where the surface stands far above the noise, W = 1 and nothing changes; frequencies that hold noise alone are
// taken out. Each run between gaps longer than `bridge_m` is filtered by itself, mirrored at both ends (its
// transform is a cosine transform). Of what is left the roughness is too small: it is measured before
// (docs/texture-noise.md). Throws Error if the two spectra differ in size or the spacing is not positive.
WienerTexture apply_wiener_filter(std::span<const double> texture_m, double spacing_m,
                                  std::span<const double> frequency_cycles_per_mm,
                                  std::span<const double> noise_psd_m2_mm, double bridge_m);

}  // namespace asperity
