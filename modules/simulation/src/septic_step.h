#pragma once

#include <algorithm>

namespace asperity {

// From 0 to 1 while `share` does, with three derivatives of zero at both ends.
inline double septic_step(double share) {
  const double u = std::clamp(share, 0.0, 1.0);
  return u * u * u * u * (35.0 + u * (-84.0 + u * (70.0 - 20.0 * u)));
}

}  // namespace asperity
