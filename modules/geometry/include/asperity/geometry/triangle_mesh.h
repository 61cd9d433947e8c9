#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// Three indices of vertices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

// A surface of triangles in the mesh frame. It may be open, non-manifold or have several parts.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices_m;
  std::vector<Triangle> triangles;
};

}  // namespace asperity
