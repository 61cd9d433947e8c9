#include "asperity/pipeline/live_config.h"

namespace asperity {

LiveProfileConfig live_profile_config(const ProcessConfig& config) {
  LiveProfileConfig out;
  out.fused = config.fused;
  out.base = config.base;
  out.profile = config.profile;
  if (config.method == Method::kThesis) {
    const ThesisProfileConfig& thesis = config.thesis.profile;
    out.profile.spacing_m = thesis.spacing_m;
    out.profile.cutoff_cycles_per_mm = thesis.cutoff_cycles_per_mm;
    out.min_speed_mps = thesis.min_speed_mps;
    out.scale_by_force = thesis.scale_by_force;
    out.force_window_s = thesis.force_window_s;
  }
  return out;
}

}  // namespace asperity
