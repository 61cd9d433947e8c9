#include "asperity/pipeline/fused_method.h"

#include "asperity/pipeline/height_errors.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/profile/make_profile.h"

namespace asperity {

ProcessMethod FusedMethod::make_method() {
  ProcessMethod out;
  out.estimate_trajectory = [](const Recording& recording, const ProcessConfig& config, const Observer& observer) {
    return estimate_trajectory_fused(recording, config.fused, observer);
  };
  out.make_profile = [](const ProcessConfig& config, const TipMotion& motion, const BasePathResult& base) {
    return make_profile(motion, base.path, base.contact, config.profile);
  };
  out.height_errors = [](const Recording& recording, const ProcessConfig&, const TrajectoryResult& trajectory,
                         const BasePathResult& base) { return height_errors(recording, trajectory, base); };
  out.estimate_compliance = [](const Recording&, const ProcessConfig& config, const TipMotion& motion,
                               const BasePathResult& base) {
    return estimate_compliance(motion, motion.t_ns, base.path.n_world, config.compliance);
  };
  out.uses_normal_force = true;
  out.high_pass_cycles_per_mm = [](const ProcessConfig& config) { return config.profile.cutoff_cycles_per_mm; };
  out.live_config = [](const ProcessConfig& config) {
    LiveProfileConfig live;
    live.fused = config.fused;
    live.base = config.base;
    live.profile = config.profile;
    return live;
  };
  out.is_same_trajectory = [](const ProcessConfig& a, const ProcessConfig& b) {
    return is_same_config(a.fused, b.fused);
  };
  out.is_same_profile = [](const ProcessConfig& a, const ProcessConfig& b) {
    return is_same_config(a.profile, b.profile);
  };
  return out;
}

}  // namespace asperity
