#pragma once

#include <array>

namespace asperity {

// The four cubic B-splines over a cell at t in [0, 1], and their derivatives.
inline void spline_weights(double t, std::array<double, 4>& weight, std::array<double, 4>& slope) noexcept {
  const double s = 1.0 - t;
  weight = {s * s * s / 6.0, (4.0 - 3.0 * t * t * (1.0 + s)) / 6.0, (4.0 - 3.0 * s * s * (1.0 + t)) / 6.0,
            t * t * t / 6.0};
  slope = {-0.5 * s * s, -2.0 * t + 1.5 * t * t, 2.0 * s - 1.5 * s * s, 0.5 * t * t};
}

}  // namespace asperity
