#pragma once

#include "asperity/base/areal_map.h"

namespace asperity {

// The mean surface of a map by the robust Gaussian regression filter of ISO 16610-71, of second degree: at each point
// the quadric that minimises Σ δ_j s_j (z_j − quadric)², with s_j = exp(−π (x² + y²)/(α λ)²) and α = 0.7309, so that
// the linear filter passes a wave of length λ in any direction by half: with u = (2π σ/λ)²/2 its transmission is (1 +
// u) e^−u, as of the profile's filter (robust_gaussian_filter.h), for the weight's second Hermite terms along x and y
// add up. The weights δ = (1 − (r/c)²)² within |r| < c, else 0, r the distance from the last mean surface and c
// = 4.4478 times the median of |r| (Tukey's biweight), make deep pits and high peaks count for nothing. Iterated from δ
// = 1 until c changes by less than 1e-4 of itself, 30 times at most. Edges need no other rule; where too little is
// present for a quadric, a plane is fitted, or the mean. nan heights stay nan and count for nothing. Time in proportion
// to heights times the logarithm of the map's size times iterations. Throws Error unless the cut-off is positive.
//
// Source: the publications named in robust_gaussian_filter.h, of which this is the form in two dimensions; the
// standard's own text was not read.
ArealMap robust_gaussian_mean_surface(const ArealMap& map, double cutoff_m);

}  // namespace asperity
