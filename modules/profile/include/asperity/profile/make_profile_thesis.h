#pragma once

#include <cstddef>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"
#include "asperity/profile/profile.h"

namespace asperity {

struct ThesisProfileConfig {
  bool scale_by_force = true;
  double force_window_s = 0.1;
  double min_speed_mps = 0.005;
  double spacing_m = 0.025e-3;
  double cutoff_cycles_per_mm = 0.4;
  int order = 2;

  template <class V>
  void visit(V& v) {
    v.field("scale_by_force", scale_by_force, "even out the hand's force in the acceleration");
    v.field("force_window_s", force_window_s, "moving average of the force before, s", {0.0, 1e3});
    v.field("min_speed_mps", min_speed_mps, "slower samples stick or rest and become gaps, m/s", {0.0, 10.0});
    v.field("spacing_m", spacing_m, "of the profile along the path, m", {1e-7, 1e-2});
    v.field("cutoff_cycles_per_mm", cutoff_cycles_per_mm, "of the high-pass, -3 dB of the whole zero-phase filter",
            {0.0, 20.0});
    v.field("order", order, "of the Butterworth high-pass, each pass", {1, 8});
  }
};

struct ThesisProfileResult {
  Profile profile;               // height_m with the integration's drift, texture_m without; sigma_m is nan
  std::size_t slow_samples = 0;  // dropped as stick and slip, or at rest
  std::size_t samples = 0;       // of the motion
  double length_m = 0.0;         // from the first to the last sample that moves
};

// The surface profile by the seed's method from the motion and its base path (B.1, §4.3 to §5.2): the
// acceleration blended along the normal, scaled by the force, integrated twice, stick and slip marked as
// gaps, laid over the distance along the filtered path, resampled and high-pass filtered.
// `motion` is uniform in time (estimate_trajectory_thesis); of `base` only the normals are used. A cut-off
// of 0 leaves texture_m as height_m. Throws Error if the sizes differ, if times are not uniform, or if
// nothing moves.
ThesisProfileResult make_profile_thesis(const TipMotion& motion, const BasePath& base,
                                        const ThesisProfileConfig& config);

// The profile's texture_m: its heights high-passed, gaps bridged by straight lines for the filter and marked again
// (seed §5.2).
std::vector<double> extract_texture_thesis(const std::vector<double>& height_m, const ThesisProfileConfig& config);

}  // namespace asperity
