#include "asperity/pipeline/ekf_method.h"

#include "asperity/pipeline/process_config.h"
#include "asperity/trajectory/estimate_trajectory_ekf.h"

namespace asperity {

ProcessMethod EkfMethod::make_method() {
  ProcessMethod out = FusedMethod::make_method();  // its other steps serve
  out.height_errors = nullptr;                     // those are of a smoothed path
  out.estimate_trajectory = [](const Recording& recording, const ProcessConfig& config, const Observer& observer) {
    return estimate_trajectory_ekf(recording, config.fused, config.ekf, observer);
  };
  out.is_same_trajectory = [](const ProcessConfig& a, const ProcessConfig& b) {
    return is_same_config(a.fused, b.fused) && is_same_config(a.ekf, b.ekf);
  };
  return out;
}

}  // namespace asperity
