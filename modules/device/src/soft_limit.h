#pragma once

#include <cmath>

namespace asperity {

// `x` up to half of `ceiling`, then bent so that it never reaches it: k + (c − k) tanh((|x| − k)/(c − k)), k = c/2;
// continuous with its first derivative. What is no number is 0.
inline double soft_limit(double x, double ceiling) noexcept {
  const double knee = 0.5 * ceiling, size = std::abs(x);
  if (size <= knee) return x;
  if (std::isnan(x)) return 0.0;
  return std::copysign(knee + (ceiling - knee) * std::tanh((size - knee) / (ceiling - knee)), x);
}

// The largest float that is not above `value`.
inline float largest_float_within(double value) noexcept {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) <= value ? nearest : std::nextafter(nearest, 0.0F);
}

}  // namespace asperity
