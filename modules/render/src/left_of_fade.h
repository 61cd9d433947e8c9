#pragma once

#include <algorithm>

namespace asperity {

// 1 at 0, 0 from 1 on, without a corner at either end.
inline double left_of_fade(double part) noexcept {
  const double t = std::clamp(part, 0.0, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

}  // namespace asperity
