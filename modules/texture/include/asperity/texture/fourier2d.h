#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "asperity/texture/fourier1d.h"
#include "asperity/texture/spline_grid.h"

namespace asperity {

enum class Fourier2dKind { kOuter, kPattern, kIsotropic };
inline constexpr std::array<std::string_view, 3> kFourier2dKindNames{"outer", "pattern", "isotropic"};

// The power spectrum of a periodic, statistically isotropic surface with random phases.
struct IsotropicSpectrum {
  double length_mm = 10.0;  // period in both directions
  std::vector<double>
      power_m2;  // [j - 1]: of each wave (m, n) of the lattice with round(√(m² + n²)) = j, (−m, −n) apart
  double mean_m = 0.0;
  std::int64_t seed = 0;  // of the phases
};

// A height over a plane, periodic in both directions (thesis §6.5, erratum 21):
//   kOuter, kPattern   h(x, y) = offset_m + scale_per_m · x(x) · y(y)
//   kIsotropic         h(x, y) = Σ over the spectrum's waves, held as the spline `grid`, which
//                      synthesize_isotropic() makes of the spectrum
struct Fourier2d {
  Fourier2dKind kind = Fourier2dKind::kOuter;
  Fourier1d x;
  Fourier1d y;
  double scale_per_m = 1.0;
  double offset_m = 0.0;
  IsotropicSpectrum isotropic;
  SplineGrid grid;
};

}  // namespace asperity
