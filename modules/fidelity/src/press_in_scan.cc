#include "asperity/fidelity/press_in_scan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/pipeline/process_motion.h"
#include "asperity/profile/base_path_on_mesh.h"
#include "asperity/scene/material_at.h"
#include "asperity/signal/resample.h"

namespace asperity {

using Eigen::Vector3d;

namespace {

constexpr double kApproach_m = 1e-3;
constexpr std::int64_t kApproach_ns = 100'000'000, kApproachStep_ns = 1'000'000;

// The readings, with straight lines between them.
std::vector<double> bridged_force(const TipMotion& motion) {
  if (motion.force_N.size() != motion.size() ||
      std::none_of(motion.force_N.begin(), motion.force_N.end(), [](double f) { return std::isfinite(f); })) {
    throw Error("press in: the recording has no force");
  }
  std::vector<double> t_s;
  t_s.reserve(motion.size());
  for (const std::int64_t t_ns : motion.t_ns) t_s.push_back(1e-9 * static_cast<double>(t_ns - motion.t_ns.front()));
  return bridge_gaps(t_s, motion.force_N);
}

}  // namespace

ProcessResult measure_on_scene(const Recording& recording, const Scene& scene, const ProcessConfig& config,
                               const Observer& observer) {
  if (!scene.T_mesh_world)
    throw Error(
        "the scene has no registration (T_mesh_world), so that the position of the scan is not known; register the "
        "scan first");
  if (scene.objects.empty()) throw Error("the scene has no object");
  ProcessResult result = estimate_motion(recording, config, observer);
  const MeshSurface surface(to_metres(scene.objects.front().mesh, scene.objects.front().unit_m));
  const FindBase find_base = [&](const TipMotion& motion) {
    return base_path_on_mesh(motion, recording.calibration.tip_in_marker_m, surface, *scene.T_mesh_world, config.base);
  };
  measure_along(recording, config, find_base, result, observer);
  return result;
}

PressedScan press_in_scan(const ProcessResult& measured, const Scene& scene, double stiffness_N_per_m) {
  const TipMotion& motion = measured.trajectory.motion;
  const BasePath& base = measured.base.path;
  if (!scene.T_mesh_world) throw Error("press in: the scene has no registration");
  if (base.size() == 0 || base.size() != motion.size()) throw Error("press in: the scan has no base path");
  if (scene.objects.empty()) throw Error("press in: the scene has no object");
  const SceneObject& object = scene.objects.front();
  const TriangleMesh mesh = to_metres(object.mesh, object.unit_m);
  const MeshBvh bvh(mesh);
  const Pose T_scene_tracker = object.T_world_mesh * *scene.T_mesh_world;
  const std::vector<double> force_N = bridged_force(motion);

  PressedScan out;
  double texture_N_per_m = 0.0;  // of the last place in contact
  const auto add = [&](std::int64_t t_ns, const Vector3d& p_world_m, std::size_t i, double force, bool contact) {
    out.path.t_ns.push_back(t_ns);
    out.path.p_world_m.push_back(p_world_m);
    out.s_m.push_back(base.s_m[i]);
    out.force_N.push_back(force);
    out.n_world.push_back(T_scene_tracker.rotation * base.n_world[i]);
    out.contact.push_back(contact ? 1 : 0);
    out.texture_N_per_m.push_back(texture_N_per_m);
  };
  ClosestPoint on;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const bool contact = measured.base.contact.empty() || measured.base.contact[i] != 0;
    double above_m = std::max((motion.p_world_tip_m[i] - base.p_world_m[i]).dot(base.n_world[i]), 0.0);
    double force = 0.0;
    if (contact) {
      const Vector3d p_mesh_m = *scene.T_mesh_world * base.p_world_m[i];
      on = on.found() ? bvh.closest_point(p_mesh_m, on) : bvh.closest_point(p_mesh_m);
      const Material known = material_at(scene, object, on.triangle, on.barycentric);
      const double k = std::isfinite(known.stiffness_N_per_m) ? known.stiffness_N_per_m : stiffness_N_per_m;
      texture_N_per_m = k * (std::isfinite(known.compliance_kc) ? known.compliance_kc : 1.0);
      if (!(k > 0.0)) throw Error("press in: the stiffness is not positive");
      force = std::max(force_N[i], 0.0);
      above_m = -force / k;
    }
    const Vector3d p_world_m = T_scene_tracker * Vector3d(base.p_world_m[i] + above_m * base.n_world[i]);
    const Vector3d n_world = T_scene_tracker.rotation * base.n_world[i];
    if (i == 0) {
      for (std::int64_t t_ns = 0; t_ns < kApproach_ns; t_ns += kApproachStep_ns) {
        const double left = 1.0 - static_cast<double>(t_ns) / static_cast<double>(kApproach_ns);
        add(t_ns, p_world_m + left * (kApproach_m + std::max(-above_m, 0.0)) * n_world, i, 0.0, false);
      }
    }
    add(kApproach_ns + motion.t_ns[i] - motion.t_ns.front(), p_world_m, i, force, contact);
  }
  return out;
}

}  // namespace asperity
