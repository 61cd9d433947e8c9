#pragma once

#include <vector>

#include "asperity/texture/fourier2d.h"
#include "asperity/texture/spline_grid.h"

namespace asperity {

inline constexpr std::size_t kMostIsotropicHarmonics = 256;

// The surface of a spectrum: with ω = 2π/L and P_j the power of the waves whose radius √(m² + n²) rounds to j,
//   h(x, y) = mean + Σ_{(m,n)} √P_j cos(ω(mx + ny) + φ_mn),  φ_{−m,−n} = −φ_mn,
// the φ_mn drawn evenly from the seed. Its variance is Σ P over the lattice, whatever the seed. Returned as a
// periodic cubic spline on at least 4 points a wave of the highest harmonic, which is h at its points. Throws
// Error for a spectrum that is empty, longer than kMostIsotropicHarmonics, or holds a negative power.
SplineGrid synthesize_isotropic(const IsotropicSpectrum& spectrum);

// The mean power of the harmonics m = 1…N of straight sections of that surface, in every direction of an axis:
// S_m = 2 Σ_n P_round(√(m²+n²)).
std::vector<double> section_power_m2(const IsotropicSpectrum& spectrum);

}  // namespace asperity
