#pragma once

#include <span>
#include <vector>

namespace asperity {

// A texture less the noise that is expected in it.
struct WienerTexture {
  std::vector<double> texture_m;      // the expected texture, given what was measured
  double error_rms_m = 0.0;           // of texture_m, expected
  double error_ratio = 0.0;           // of that to the measured texture's
  double kept_rms_m = 0.0;            // of the error that was not to be removed, in texture_m
  double expected_correlation = 0.0;  // of texture_m with the true texture
};

// Wiener's filter (N. Wiener, 1949) of a measured texture h + n, whose noise n has the known one-sided density
// S_n(k) (m²/(cycles/mm) at rising frequencies, `noise_psd_m2_mm`), the surface's density being estimated from the
// data themselves:
//
//   W(k) = max(0, 1 − S_n(k)/P(k)),   P the periodogram over ± 4 bins or ± k/16,
//   texture = W · measured,   error² = ∫ W S_n dk,   correlation² = ∫ W (P − S_n)₊ dk / ∫ (P − S_n)₊ dk.
//
// With a second error m of the density S_m (`kept_psd_m2_mm`, empty: none) of which nothing is to be removed, since its
// expected value is 0 (carried_psd_m2_mm in texture_noise.h), W is the same and the error that is left is
//
//   error² = ∫ (1 − W)² (P − S_n − S_m)₊ + W² (S_n + S_m) dk,
//
// which is the former for S_m = 0. S_m is taken as no larger than (P − S_n)₊.
//
// Where the surface stands far above the noise, W = 1 and nothing changes; frequencies that hold noise alone are
// taken out. Each run between gaps longer than `bridge_m` is filtered by itself, mirrored at both ends (its
// transform is a cosine transform). Of what is left the roughness is too small: it is measured before
// (docs/texture-noise.md). Throws Error if the two spectra differ in size or the spacing is not positive.
WienerTexture apply_wiener_filter(std::span<const double> texture_m, double spacing_m,
                                  std::span<const double> frequency_cycles_per_mm,
                                  std::span<const double> noise_psd_m2_mm, double bridge_m,
                                  std::span<const double> kept_psd_m2_mm = {});

}  // namespace asperity
