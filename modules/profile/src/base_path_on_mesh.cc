#include "asperity/profile/base_path_on_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"
#include "asperity/signal/statistics.h"
#include "development.h"
#include "motion_times.h"

namespace asperity {

BasePathResult base_path_on_mesh(const TipMotion& motion, const Eigen::Vector3d& tip_in_marker_m,
                                 const MeshSurface& surface, const Pose& T_mesh_world, const BasePathConfig& config,
                                 double bulge_share) {
  const std::vector<double> t_s = motion_times_s(motion);
  if (!tip_in_marker_m.allFinite()) throw Error("base path: tip_in_marker_m is not finite");
  const std::size_t n = motion.size();
  BasePathResult out;
  out.shape = PathShape::kMesh;
  out.contact = find_contact(motion, config.contact);
  const Pose T_world_mesh = T_mesh_world.inverse();

  std::vector<double> height_m(n);
  std::vector<Eigen::Vector2d> developed;
  developed.reserve(n);
  out.path.p_world_m.reserve(n);
  out.path.n_world.reserve(n);
  Development development;
  ClosestPoint closest;
  std::size_t beyond = 0, touching = 0;
  double axis_sum = 0.0, square_m2 = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d p_mesh_m = T_mesh_world * motion.p_world_tip_m[i];
    closest = closest.found() ? surface.bvh.closest_point(p_mesh_m, closest) : surface.bvh.closest_point(p_mesh_m);
    const NormalFoot foot = foot_along_normal(surface, p_mesh_m, closest);
    // Where the mesh has no normal, that before goes on.
    if (foot.normal.squaredNorm() > 0.5) normal = T_world_mesh.rotation * foot.normal;
    if (!(normal.squaredNorm() > 0.5))
      throw Error("base path: the mesh has no normal under sample " + std::to_string(i));
    Eigen::Vector3d base_m = foot.p_m;
    if (foot.on_normal && bulge_share != 0.0) {
      base_m += bulge_share * facet_bulge_m(surface, foot.triangle, foot.barycentric) * foot.normal;
    }
    out.path.p_world_m.push_back(T_world_mesh * base_m);
    out.path.n_world.push_back(normal);
    developed.push_back(development.add(out.path.p_world_m.back(), normal));
    height_m[i] = normal.dot(motion.p_world_tip_m[i] - out.path.p_world_m[i]);
    if (out.contact[i] == 0) continue;
    beyond += foot.on_normal ? 0 : 1;
    axis_sum += normal.dot(motion.q_world_marker[i] * -tip_in_marker_m);
  }

  if (axis_sum < 0.0) {
    for (Eigen::Vector3d& outward : out.path.n_world) outward = -outward;
    for (double& height : height_m) height = -height;
    out.problems.push_back(
        {"inward_normals", "the probe is on the inner side of the mesh: its normals were reversed", 1});
  }
  if (beyond > 0) {
    out.problems.push_back({"beyond_the_mesh",
                            "samples beyond a border of the mesh or across a fold have heights over its nearest point",
                            beyond});
  }
  if (motion.force_N.empty() ||
      std::none_of(motion.force_N.begin(), motion.force_N.end(), [](double force) { return std::isfinite(force); })) {
    for (std::size_t i = 0; i < n; ++i) {
      if (std::abs(height_m[i]) > config.max_height_m) out.contact[i] = 0;
    }
  }
  out.axis_world = Eigen::Vector3d::Zero();
  double tilt_sum = 0.0;
  const double length = tip_in_marker_m.norm();
  for (std::size_t i = 0; i < n; ++i) {
    if (out.contact[i] == 0) continue;
    ++touching;
    square_m2 += height_m[i] * height_m[i];
    out.centre_world_m += out.path.p_world_m[i];
    out.axis_world += out.path.n_world[i];
    if (!(length > 0.0)) continue;
    const double cosine = out.path.n_world[i].dot(motion.q_world_marker[i] * (-tip_in_marker_m / length));
    tilt_sum += std::acos(std::clamp(cosine, -1.0, 1.0));
  }
  out.axis_world.normalize();
  if (touching > 0) {
    out.centre_world_m /= static_cast<double>(touching);
    out.base_rms_m = std::sqrt(square_m2 / static_cast<double>(touching));
    out.probe_tilt_deg = tilt_sum / static_cast<double>(touching) * 180.0 / std::numbers::pi;
  }

  follow_path(motion, t_s, developed, config, out);
  return out;
}

}  // namespace asperity
