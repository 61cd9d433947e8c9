#pragma once

#include <cstdint>

#include "asperity/geometry/haptic_triangle.h"

namespace asperity {

// The haptic texture that a triangle has below another one: it is not rendered until that is taken out.
struct CoveredTriangle {
  std::uint32_t triangle = 0;
  HapticTriangle haptic;
};

}  // namespace asperity
