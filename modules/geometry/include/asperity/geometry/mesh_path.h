#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// A path on a mesh: points on its triangles in order, and the length along the surface up to each.
// One entry a point in every vector.
struct MeshPath {
  std::vector<Eigen::Vector3d> p_mesh_m;
  std::vector<std::uint32_t> triangle;
  std::vector<double> s_m;  // from 0, not falling

  std::size_t size() const { return p_mesh_m.size(); }
};

}  // namespace asperity
