#pragma once

#include <cstdint>

#include "asperity/geometry/haptic_triangle.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// How a triangle's haptic coordinates map it from the surface to (x, y).
struct TriangleStretch {
  double low = 1.0;  // singular values: 1 where lengths are kept
  double high = 1.0;
  double area_m2 = 0.0;
  bool folded = false;  // turned over: seen from outside, x × y points inwards (erratum 17)
  bool known = false;   // false: the triangle has no area, and there is nothing to feel
};

// Of triangle `triangle` of a mesh in metres with coordinates in millimetres.
TriangleStretch triangle_stretch(const TriangleMesh& mesh, std::uint32_t triangle, const HapticTriangle& coordinates);

}  // namespace asperity
