#pragma once

#include <span>
#include <vector>

#include "asperity/base/progress.h"

namespace asperity {

// The mean line of a uniform profile by the robust Gaussian regression filter of ISO 16610-31, of second degree: at
// each sample the parabola that minimises Σ δ_j s_j (z_j − parabola)², with s_j = exp(−π (x/(α λ))²) and α = 0.7309,
// so that the linear filter passes a wave of length λ by half: with u = (2π σ/λ)²/2 its transmission is (1 + u) e^−u.
// The weights δ = (1 − (r/c)²)² within |r| < c, else 0, r the distance from the last mean line and
// c = 4.4478 times the median of |r| (Tukey's biweight), make deep pits and high peaks count for nothing. Iterated from
// δ = 1 until c changes by less than 1e-4 of itself, 30 times at most. Ends need no other rule: a parabola is kept up
// to the end. nan heights stay nan and count for nothing. Takes time in proportion to samples times the logarithm of
// their number times iterations. Throws Error unless both lengths are positive.
//
// Source: the method's publications, Seewig, J. Phys. Conf. Ser. 13, 254 (2005), and Brinkmann, Bodschwinna and Lemke,
// Int. J. Mach. Tools Manuf. 41, 2153 (2001); the standard's own text was not read.
std::vector<double> robust_gaussian_mean_line_m(std::span<const double> height_m, double spacing_m, double cutoff_m,
                                                const Observer& observer = {});

}  // namespace asperity
