#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// The seed's scale of the acceleration that evens out the hand's force: s = 1 − (f − f_mean)/(f_max − f_min)
// for each sample, with f after a moving average over `half_width` samples to either side and its own mean,
// maximum and minimum (seed §4.4, erratum 14). All 1 where f_max = f_min (erratum 25) or where there is no
// force at all; cells that are nan are bridged by straight lines first.
std::vector<double> force_scale(std::span<const double> force_N, std::size_t half_width);

}  // namespace asperity
