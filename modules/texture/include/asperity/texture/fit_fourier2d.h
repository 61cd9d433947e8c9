#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "asperity/base/problem.h"
#include "asperity/texture/fourier1d.h"
#include "asperity/texture/fourier2d.h"

namespace asperity {

enum class Fourier2dFitKind { kAuto, kOuter, kPattern, kIsotropic };
inline constexpr std::array<std::string_view, 4> kFourier2dFitKindNames{"auto", "outer", "pattern", "isotropic"};

struct FitFourier2dConfig {
  Fourier2dFitKind kind = Fourier2dFitKind::kAuto;
  std::int64_t seed = 0;
  int coefficients = 128;
  double resolution = 0.25;
  int iterations = 500;

  template <class V>
  void visit(V& v) {
    v.choice("kind", kind, kFourier2dFitKindNames,
             "outer: product of the profiles; pattern: product of depths; isotropic: random phases; auto: pattern for "
             "a periodic profile, else isotropic");
    v.field("seed", seed, "isotropic: of the phases", {0.0, 9e15});
    v.field("coefficients", coefficients, "isotropic: harmonics kept of the profile's", {1, 256});
    v.field("resolution", resolution,
            "isotropic: relative width of the bands in which the spectrum is smoothed, 3 harmonics at least",
            {0.0, 1.0});
    v.field("iterations", iterations, "isotropic: steps from the profile's spectrum to the surface's", {1, 100000});
  }
};

struct Fourier2dFit {
  Fourier2d texture;
  double rms_height_m = 0.0;    // of the surface about its mean
  double source_rms_m = 0.0;    // of the profile, or the geometric mean of both
  double spectrum_error = 0.0;  // isotropic: Σ|S − S_source| / Σ S_source over the smoothed bands of sections
  double height_offset_m = 0.0;
  Problems problems;  // "not_isotropic"
};

// A surface from the profile along x and the one along y (the same if there is only one; thesis §6.5,
// erratum 21). With g the profiles less their means, d = max g − g their depths:
//   outer      h = s·g(x)g(y), s so that the RMS height is the profiles' (their geometric mean). Where the
//              profile has a hole, the product of two holes is a peak.
//   pattern    h = max − d(x)d(y)/d_max: a hole where both profiles have one, the profile itself along
//              the line of the deepest hole
//   isotropic  the spectrum P of a surface without a direction whose sections have, in the mean, the
//              profile's: Σ over rings of radius j of 2·(lattice points of the ring in column m)·P_j = S_m,
//              S_m = (a_m² + b_m²)/2 smoothed in bands, solved for P ≥ 0 by Richardson-Lucy steps (1972,
//              1974), which keep Σ S_m. Only `x` counts. A profile whose spectrum has a peak cannot be a
//              section of an isotropic surface: spectrum_error says by how much, a Problem from 0.2 on.
//   auto       pattern if the profiles are `periodic` (find_periodicity.h decides for the command), else isotropic
// Throws Error for profiles that are flat or of unequal coefficient counts.
Fourier2dFit fit_fourier2d(const Fourier1d& x, const Fourier1d& y, const FitFourier2dConfig& config = {},
                           bool periodic = false);

}  // namespace asperity
