#include "asperity/pipeline/scan_on_mesh.h"

#include <algorithm>

namespace asperity {

MeshPath scan_on_mesh(const BasePathResult& base, const MeshSurface& surface, const Pose& T_mesh_world,
                      const ScanOnMeshConfig& config) {
  MeshPath out;
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  double s_sum_m = 0.0, begin_m = 0.0;
  std::size_t count = 0;
  ClosestPoint closest;
  const auto close = [&] {
    if (count == 0) return;
    const double share = 1.0 / static_cast<double>(count);
    const Eigen::Vector3d p_mesh_m = T_mesh_world * Eigen::Vector3d(share * sum_m);
    closest = closest.found() ? surface.bvh.closest_point(p_mesh_m, closest) : surface.bvh.closest_point(p_mesh_m);
    const double s_m = share * s_sum_m;
    if (closest.found() && (out.s_m.empty() || s_m > out.s_m.back())) {
      out.p_mesh_m.push_back(closest.p_m);
      out.triangle.push_back(closest.triangle);
      out.s_m.push_back(s_m);
    }
    sum_m.setZero();
    s_sum_m = 0.0;
    count = 0;
  };
  for (std::size_t i = 0; i < base.path.size(); ++i) {
    if (base.contact[i] == 0) continue;
    const double s_m = base.path.s_m[i];
    if (count > 0 && s_m >= begin_m + config.spacing_m) close();
    if (count == 0) begin_m = out.s_m.empty() ? s_m : std::max(s_m, out.s_m.back());
    sum_m += base.path.p_world_m[i];
    s_sum_m += s_m;
    ++count;
  }
  close();
  return out;
}

}  // namespace asperity
