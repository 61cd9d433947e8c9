#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asperity/geometry/haptic_triangle.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/registration/haptic_coordinates.h"

namespace asperity {

// Fills in the numbers and lists of stretch and folds of the triangles `chosen`. Seen from outside, x × y
// points inwards (erratum 17): a map that keeps the triangle's turn is a fold.
void measure_warp(const TriangleMesh& mesh, std::span<const std::uint32_t> chosen,
                  const std::vector<HapticTriangle>& triangles, double stretch_limit, HapticWarp& warp);

}  // namespace asperity
