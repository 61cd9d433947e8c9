#include "asperity/pipeline/raw_method.h"

#include "asperity/pipeline/process_config.h"
#include "asperity/trajectory/estimate_trajectory_raw.h"

namespace asperity {

ProcessMethod RawMethod::make_method() {
  ProcessMethod out = FusedMethod::make_method();  // its other steps serve
  out.height_errors = nullptr;                     // those are of a smoothed path
  out.estimate_trajectory = [](const Recording& recording, const ProcessConfig& config, const Observer&) {
    return estimate_trajectory_raw(recording, config.raw);
  };
  out.is_same_trajectory = [](const ProcessConfig& a, const ProcessConfig& b) { return is_same_config(a.raw, b.raw); };
  return out;
}

}  // namespace asperity
