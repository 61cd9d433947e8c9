#pragma once

#include <algorithm>

namespace asperity {

// 3t² − 2t³ of t clamped to [0, 1]: from 0 to 1, with no slope at either end. NaN stays NaN. Realtime-safe: yes.
constexpr double smoothstep(double t) noexcept {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

}  // namespace asperity
