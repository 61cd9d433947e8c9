#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// The mean of the `half_width` samples on either side of each and itself (2·half_width + 1 in all); at
// the ends the mean of those that exist. x must be finite. Linear time, without the drift of a running
// sum.
std::vector<double> moving_average(std::span<const double> x, std::size_t half_width);

}  // namespace asperity
