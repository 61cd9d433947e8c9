#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_point.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// The weights of the foot of `p` on the triangle's plane, kept within the triangle; its first corner if it has no area.
Eigen::Vector3d weights_of(const TriangleMesh& mesh, std::uint32_t triangle, const Eigen::Vector3d& p);

// The point of a mesh at `p`, which lies on `triangle`. A triangle that names a vertex twice has no neighbours (the
// closest-point search may find it all the same): the point goes to one that shares its edge or, if there is none, its
// vertex.
MeshPoint connected_point(const TriangleMesh& mesh, const MeshAdjacency& adjacency, std::uint32_t triangle,
                          const Eigen::Vector3d& p);

}  // namespace asperity
