#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"

namespace asperity::studio {

// How far points lie from a mesh.
struct PathResiduals {
  std::vector<float> distance_m;  // to the closest point of the mesh; negative on the inner side of its normal there
  std::vector<Eigen::Vector3d> normal_mesh;  // there, unit
  double mean_m = 0.0;                       // of the magnitudes (the thesis's measure, §5.4)
  double rms_m = 0.0;
  double most_m = 0.0;
};

// `previous` is empty, or the closest points of the same points at another pose, and then those of this one: near
// poses are answered faster. The points are finite.
PathResiduals path_residuals(const std::vector<Eigen::Vector3d>& p_world_m, const MeshSurface& surface,
                             const Pose& T_mesh_world, std::vector<ClosestPoint>& previous);

}  // namespace asperity::studio
