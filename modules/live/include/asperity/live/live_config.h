#pragma once

#include "asperity/profile/find_base_path.h"
#include "asperity/profile/make_profile.h"
#include "asperity/trajectory/causal_tip.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"

namespace asperity {

// The settings of the causal pipeline (docs/live-profile.md). The groups `fused`, `base` and `profile` are those of
// ProcessConfig, with the same meaning.
struct LiveProfileConfig {
  CausalTipConfig tip;
  FusedConfig fused;
  BasePathConfig base;
  ProfileConfig profile;
  double min_speed_mps = 0.0;
  bool scale_by_force = false;
  double force_window_s = 0.1;
  double max_sigma_m = 1e-3;
  double heading_span_s = 0.16;
  double base_history_s = 6.0;
  double base_period_s = 0.25;
  double base_settle_m = 10e-3;
  double tip_period_s = 4e-3;

  template <class V>
  void visit(V& v) {
    v.group("tip", tip);
    v.group("fused", fused);
    v.group("base", base);
    v.group("profile", profile);
    v.field("min_speed_mps", min_speed_mps, "slower samples stick or rest and become gaps, m/s; 0: none do",
            {0.0, 10.0});
    v.field("scale_by_force", scale_by_force, "even out the hand's force in texture_m");
    v.field("force_window_s", force_window_s, "moving average of the force before, s", {0.0, 1e3});
    v.field("max_sigma_m", max_sigma_m, "a tip less certain than this gives no height, m", {1e-6, 1.0});
    v.field("heading_span_s", heading_span_s, "time over which the direction of travel is taken, s", {0.01, 1.0});
    v.field("base_history_s", base_history_s, "of the path that the base shape is fitted to, s", {0.5, 60.0});
    v.field("base_period_s", base_period_s, "between two fits of the base shape, s", {0.05, 60.0});
    v.field("base_settle_m", base_settle_m, "distance in which the height takes over a new base, m", {1e-4, 1.0});
    v.field("tip_period_s", tip_period_s, "between two tip positions, s", {1e-4, 1.0});
  }
};

}  // namespace asperity
