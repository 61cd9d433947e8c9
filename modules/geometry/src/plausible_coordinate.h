#pragma once

#include <cmath>

namespace asperity {

// In the file's own unit: a kilometre in nanometres. What is beyond comes of no measurement and of no design, and its
// squares and products would overflow on the way.
inline constexpr double kLargestCoordinate = 1e12;

// False for nan too.
inline bool is_plausible_coordinate(double value) { return std::abs(value) <= kLargestCoordinate; }

template <class Vector>
bool has_plausible_coordinates(const Vector& p) {
  return is_plausible_coordinate(p[0]) && is_plausible_coordinate(p[1]) && is_plausible_coordinate(p[2]);
}

}  // namespace asperity
