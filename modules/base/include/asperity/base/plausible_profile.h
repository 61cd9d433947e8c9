#pragma once

#include <span>
#include <string_view>

namespace asperity {

// What is finite and still comes of no measurement of a surface; squares and products of it would overflow on the way.
inline constexpr double kPlausibleHeight_m = 1e6;
inline constexpr double kSmallestSpacing_m = 1e-12, kLargestSpacing_m = 10.0;

// Throws Error, which begins with `what`, for a spacing that is not positive or not within these limits.
void require_plausible_spacing(double spacing_m, std::string_view what);

// Throws Error, which begins with `what` and has the height's number from 1, for one that is infinite or beyond these
// limits. nan is a missing height.
void require_plausible_heights(std::span<const double> height_m, std::string_view what);

// Throws Error, which begins with `what`, for `values` (their name) that are all equal, nan left out: there is nothing
// to fit.
void require_unequal(std::string_view name, std::span<const double> values, std::string_view what);

}  // namespace asperity
