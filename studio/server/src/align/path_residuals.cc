#include "align/path_residuals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace asperity::studio {

PathResiduals path_residuals(const std::vector<Eigen::Vector3d>& p_world_m, const MeshSurface& surface,
                             const Pose& T_mesh_world, std::vector<ClosestPoint>& previous) {
  PathResiduals out;
  out.distance_m.reserve(p_world_m.size());
  out.normal_mesh.reserve(p_world_m.size());
  previous.resize(p_world_m.size());
  double square_m2 = 0.0;
  for (std::size_t i = 0; i < p_world_m.size(); ++i) {
    const Eigen::Vector3d p_m = T_mesh_world * p_world_m[i];
    ClosestPoint& closest = previous[i];
    closest = closest.found() ? surface.bvh.closest_point(p_m, closest) : surface.bvh.closest_point(p_m);
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      normal += closest.barycentric[static_cast<Eigen::Index>(k)] * surface.normals[closest.triangle][k];
    }
    out.normal_mesh.push_back(normal.normalized());
    const bool inside = (p_m - closest.p_m).dot(normal) < 0.0;
    out.distance_m.push_back(static_cast<float>(inside ? -closest.distance_m : closest.distance_m));
    out.mean_m += closest.distance_m;
    square_m2 += closest.distance_m * closest.distance_m;
    out.most_m = std::max(out.most_m, closest.distance_m);
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, p_world_m.size()));
  out.mean_m /= count;
  out.rms_m = std::sqrt(square_m2 / count);
  return out;
}

}  // namespace asperity::studio
