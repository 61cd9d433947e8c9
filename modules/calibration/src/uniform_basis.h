#pragma once

#include <array>

namespace asperity {

// The six B-splines of the fifth degree that are not zero between two of evenly spaced knots, with their first two
// derivatives by the place in units of the knots' distance, at `share` in [0, 1] of the way.
struct QuinticBasis {
  std::array<double, 6> value, first, second;
};
QuinticBasis quintic_basis(double share);

}  // namespace asperity
