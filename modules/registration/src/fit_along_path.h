#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asperity/geometry/haptic_triangle.h"
#include "asperity/geometry/triangle_mesh.h"
#include "surface_path.h"

namespace asperity {

// Corrects the coordinates of vertices so that, interpolated, they give (s, 0) along the pieces of a path:
// least squares of what is missing there, plus `smoothness` times the squared differences of corrections
// over edges, so that a correction carries on across the path. Triangles in `chosen` take part whose
// corners have the coordinates of their vertices, as `shared` says of each.
void fit_along_path(const TriangleMesh& mesh, std::span<const PathPiece> pieces, double edge_m, double smoothness,
                    std::span<const std::uint32_t> chosen, const std::vector<bool>& shared,
                    std::vector<HapticTriangle>& triangles);

}  // namespace asperity
