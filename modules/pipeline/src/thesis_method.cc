#include "asperity/pipeline/thesis_method.h"

#include "asperity/geometry/mesh_surface.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/profile/thesis_steps.h"
#include "asperity/trajectory/reject_outliers.h"
#include "asperity/trajectory/sample_at_probe.h"
#include "without_flips.h"

namespace asperity {

namespace {

// The live estimate is fused's in any case; the profile follows the seed's.
LiveProfileConfig thesis_live_config(const ProcessConfig& config) {
  const ThesisProfileConfig& thesis = config.thesis.profile;
  LiveProfileConfig live;
  live.fused = config.fused;
  live.base = config.base;
  live.profile = config.profile;
  live.profile.spacing_m = thesis.spacing_m;
  live.profile.cutoff_cycles_per_mm = thesis.cutoff_cycles_per_mm;
  live.min_speed_mps = thesis.min_speed_mps;
  live.scale_by_force = thesis.scale_by_force;
  live.force_window_s = thesis.force_window_s;
  return live;
}

}  // namespace

ProcessMethod ThesisMethod::make_method() {
  ProcessMethod out;
  out.estimate_trajectory = [](const Recording& recording, const ProcessConfig& config, const Observer&) {
    return estimate_trajectory_thesis(recording, config.thesis.trajectory);
  };
  out.make_profile = [](const ProcessConfig& config, const TipMotion& motion, const BasePathResult& base) {
    return make_profile_thesis(motion, base.path, config.thesis.profile).profile;
  };
  // The seed's motion has thinned the samples: they are taken from the recording again.
  out.estimate_compliance = [](const Recording& recording, const ProcessConfig& config, const TipMotion& motion,
                               const BasePathResult& base) {
    const Outliers outliers =
        reject_outliers(recording.probe, recording.calibration, config.thesis.trajectory.outliers);
    const TipMotion samples =
        sample_at_probe(recording.probe, outliers, recording.calibration, recording.info.gravity_world_mps2, motion);
    return estimate_compliance(samples, motion.t_ns, base.path.n_world, config.compliance);
  };
  out.high_pass_cycles_per_mm = [](const ProcessConfig& config) { return config.thesis.profile.cutoff_cycles_per_mm; };
  out.comparable_texture = [](const ProcessConfig& config, const std::vector<double>& height_m) {
    return extract_texture_thesis(height_m, config.thesis.profile);
  };
  out.register_paths = [](const ProcessConfig& config, std::span<const MeasuredPath> paths, const MeshSurface& surface,
                          const Pose& guess) {
    return register_thesis(paths, surface.bvh, guess, config.thesis.registration);
  };
  out.prepare_registration = [](const ProcessConfig& config, const Recording& recording) {
    return config.thesis.registration.reject_flips ? without_flips(recording) : recording;
  };
  out.measure_arc_length = [](BasePath& path) { path.s_m = path_length_m(path.p_world_m); };
  out.live_config = thesis_live_config;
  out.is_same_trajectory = [](const ProcessConfig& a, const ProcessConfig& b) {
    return is_same_config(a.thesis.trajectory, b.thesis.trajectory);
  };
  out.is_same_profile = [](const ProcessConfig& a, const ProcessConfig& b) {
    return is_same_config(a.thesis.profile, b.thesis.profile);
  };
  return out;
}

}  // namespace asperity
