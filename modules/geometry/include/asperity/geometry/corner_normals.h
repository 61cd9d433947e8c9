#pragma once

#include <array>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// A bend of more than this between two facets is an edge of the object; a smaller one approximates a curve.
inline constexpr double kCrease_rad = std::numbers::pi / 4.0;

// Unit normals at the corners of each triangle: as vertex_normals (mesh_normals.h), but over those facets
// only that are joined to the triangle about the vertex by edges that bend by at most `crease_rad`. So
// interpolated normals follow a smooth surface and stay straight up to an edge of a box. The facet's own
// where they cancel; zero for a degenerate triangle none of whose neighbours has a normal.
std::vector<std::array<Eigen::Vector3d, 3>> corner_normals(const TriangleMesh& mesh, const MeshAdjacency& adjacency,
                                                           double crease_rad = kCrease_rad);

}  // namespace asperity
