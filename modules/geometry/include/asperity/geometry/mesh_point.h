#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// A point on a mesh: its triangle, and its weights there, which sum to 1.
struct MeshPoint {
  std::uint32_t triangle = 0;
  Eigen::Vector3d barycentric = Eigen::Vector3d(1.0, 0.0, 0.0);
};

inline Eigen::Vector3d position_m(const TriangleMesh& mesh, const MeshPoint& point) {
  const Triangle& tri = mesh.triangles[point.triangle];
  return point.barycentric[0] * mesh.vertices_m[tri[0]] + point.barycentric[1] * mesh.vertices_m[tri[1]] +
         point.barycentric[2] * mesh.vertices_m[tri[2]];
}

}  // namespace asperity
