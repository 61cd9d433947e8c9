#include "asperity/pipeline/thesis_tuned_method.h"

#include "asperity/pipeline/process_config.h"
#include "asperity/trajectory/estimate_trajectory_tuned.h"

namespace asperity {

ProcessMethod ThesisTunedMethod::make_method() {
  ProcessMethod out = ThesisMethod::make_method();
  out.estimate_trajectory = [](const Recording& recording, const ProcessConfig& config, const Observer&) {
    return estimate_trajectory_tuned(recording, config.thesis.trajectory);
  };
  return out;
}

}  // namespace asperity
