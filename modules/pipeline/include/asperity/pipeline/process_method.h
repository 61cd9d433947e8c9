#pragma once

#include <functional>
#include <span>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/geometry/motion.h"
#include "asperity/live/live_config.h"
#include "asperity/profile/estimate_compliance.h"
#include "asperity/profile/find_base_path.h"
#include "asperity/profile/profile.h"
#include "asperity/profile/texture_noise.h"
#include "asperity/recording/recording.h"
#include "asperity/registration/registration_result.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

struct ProcessConfig;
struct MeshSurface;

// The steps between a recording and a profile that are done in one of several ways. A method fills it in a file of its
// own, fused_method.h or thesis_method.h, and is a line of process_methods.h. Each step takes all settings and uses its
// own.
struct ProcessMethod {
  // The tip's trajectory. Throws Error if the streams do not allow one, and Cancelled.
  std::function<TrajectoryResult(const Recording&, const ProcessConfig&, const Observer&)> estimate_trajectory;

  // The path under it and its normals; by the path's shape (find_base_path.h) if a method has no other. May throw
  // Error.
  std::function<BasePathResult(const Recording&, const ProcessConfig&, const TipMotion&)> find_base_path;

  // The height along the base path. May throw Error.
  std::function<Profile(const ProcessConfig&, const TipMotion&, const BasePathResult&)> make_profile;

  // The noises under the heights (texture_noise.h); a method without it says nothing of its texture's error.
  std::function<HeightErrors(const Recording&, const ProcessConfig&, const TrajectoryResult&, const BasePathResult&)>
      height_errors;

  // k_c, from the accelerations that the method's trajectory belongs to, at the probe's own rate.
  std::function<Compliance(const Recording&, const ProcessConfig&, const TipMotion&, const BasePathResult&)>
      estimate_compliance;

  // The force is taken along the surface's normal (normal_force.h), not along the sensor's axis.
  bool uses_normal_force = false;

  // The -3 dB point of the profile's high-pass.
  std::function<double(const ProcessConfig&)> high_pass_cycles_per_mm;

  // The texture of a height profile with `ProcessConfig`'s spacing by the method's own high-pass, if that is what is
  // compared with the truth; empty: the heights are.
  std::function<std::vector<double>(const ProcessConfig&, const std::vector<double>& height_m)> comparable_texture;

  // The pose of scan paths on a mesh from a guess (register_scans.h), and the arc length along a base path on it.
  // Empty: ours.
  std::function<RegistrationResult(const ProcessConfig&, std::span<const MeasuredPath>, const MeshSurface&,
                                   const Pose& T_mesh_world_guess)>
      register_paths;
  std::function<void(BasePath&)> measure_arc_length;
  // The recording that a registration goes by. Empty: as it is.
  std::function<Recording(const ProcessConfig&, const Recording&)> prepare_registration;

  // The live settings (live_profile.h) that match these.
  std::function<LiveProfileConfig(const ProcessConfig&)> live_config;

  // Whether two settings give the same trajectory, and the same profile of the same trajectory and base path.
  std::function<bool(const ProcessConfig&, const ProcessConfig&)> is_same_trajectory, is_same_profile;
};

}  // namespace asperity
