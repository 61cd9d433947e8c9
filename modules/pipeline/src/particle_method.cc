#include "asperity/pipeline/particle_method.h"

#include "asperity/pipeline/process_config.h"
#include "asperity/trajectory/estimate_trajectory_particle.h"

namespace asperity {

ProcessMethod ParticleMethod::make_method() {
  ProcessMethod out = FusedMethod::make_method();  // its other steps serve
  out.height_errors = nullptr;                     // those are of a smoothed path
  out.estimate_trajectory = [](const Recording& recording, const ProcessConfig& config, const Observer& observer) {
    return estimate_trajectory_particle(recording, config.fused, config.particle, observer);
  };
  out.is_same_trajectory = [](const ProcessConfig& a, const ProcessConfig& b) {
    return is_same_config(a.fused, b.fused) && is_same_config(a.particle, b.particle);
  };
  return out;
}

}  // namespace asperity
