#pragma once

#include <cmath>
#include <functional>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/registration/haptic_coordinates.h"

namespace asperity {

// The mesh's points nearest to those of a curve given by its length.
inline MeshPath mesh_path_on(const TriangleMesh& mesh, double length_m, double step_m,
                             const std::function<Eigen::Vector3d(double)>& curve) {
  const MeshBvh bvh(mesh);
  MeshPath path;
  const int steps = static_cast<int>(std::ceil(length_m / step_m));
  for (int i = 0; i <= steps; ++i) {
    const double s_m = length_m * i / steps;
    const ClosestPoint c = bvh.closest_point(curve(s_m));
    path.p_mesh_m.push_back(c.p_m);
    path.triangle.push_back(c.triangle);
    path.s_m.push_back(s_m);
  }
  return path;
}

}  // namespace asperity
