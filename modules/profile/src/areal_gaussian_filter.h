#pragma once

#include "asperity/base/areal_map.h"

namespace asperity {

// The mean surface of a map by the Gaussian filter of ISO 16610-61: weights exp(−π (x² + y²)/(α λ)²) with
// α = sqrt(ln 2 / π), so that a wave of length λ in any direction is passed by half. At edges and beside missing
// heights the plane with these weights is fitted and evaluated, as gaussian_mean_line_m() fits a line. Missing heights
// stay nan. Time in proportion to heights times the logarithm of the map's size. Throws Error unless the cut-off is
// positive.
ArealMap gaussian_mean_surface(const ArealMap& map, double cutoff_m);

}  // namespace asperity
