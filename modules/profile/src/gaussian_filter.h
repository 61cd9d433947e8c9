#pragma once

#include <span>
#include <vector>

#include "asperity/base/progress.h"

namespace asperity {

// The mean line of a uniform profile by the Gaussian filter of ISO 16610-21: weights
// exp(−π (x / (α λ))²) with α = sqrt(ln 2 / π), so that a wave of length λ is passed by half. Where the
// window meets an end or a nan, the local straight line with these weights is evaluated instead, which
// keeps lines exact (moment criterion of ISO/TS 16610-28). nan heights stay nan. Takes time in
// proportion to samples times the logarithm of their number. Throws Error unless both lengths are positive.
std::vector<double> gaussian_mean_line_m(std::span<const double> height_m, double spacing_m, double cutoff_m,
                                         const Observer& observer = {});

}  // namespace asperity
