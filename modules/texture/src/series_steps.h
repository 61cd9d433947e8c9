#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/base/random.h"
#include "asperity/base/smoothstep.h"

namespace asperity {

// A standard normal deviate in fixed time (Box and Muller 1958, one of the pair): no rejection as in
// Random::normal, whose time varies. |z| <= 8.6.
inline double fixed_time_normal(Random& random) noexcept {
  const double u = 1.0 - random.uniform();  // (0, 1]
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * random.uniform());
}

// 0 at 0, 1 from `full` on, C¹ between; 1 everywhere for full = 0; 0 for what is not a number.
inline double fade_factor(double x, double full) noexcept {
  if (!(x > 0.0)) return full > 0.0 ? 0.0 : (x == 0.0 ? 1.0 : 0.0);
  if (!(x < full)) return 1.0;
  return smoothstep(x / full);
}

// A servo's input made harmless: not finite or negative is 0.
inline double servo_input(double x) noexcept { return x > 0.0 && std::isfinite(x) ? x : 0.0; }

// Moved up by `offset_sigmas`·σ and kept between the geometric surface and as far above (erratum 20); 0: as it is.
inline double with_offset(double value, double sigma, double offset_sigmas) noexcept {
  if (!(offset_sigmas > 0.0)) return value;
  return std::clamp(value + offset_sigmas * sigma, 0.0, 2.0 * offset_sigmas * sigma);
}

}  // namespace asperity
