#pragma once

namespace asperity {

// Limits of what reaches a hand. No scene can raise them; a device's own limits lower them.
struct SafetyConfig {
  double max_force_N = 5.0;
  double max_force_rate_N_per_s = 2000.0;
  double soft_start_s = 0.5;               // force grows from zero over this time after start or a fault
  double stale_after_s = 0.02;             // without news from the device the force ramps to zero
  double ramp_down_s = 0.02;               // of that ramp, and of every other end
  bool passivity = true;                   // observe the energy given to the hand and damp what the loop created
  double max_damping_N_s_per_m = 5.0;      // of the passivity controller
  double assumed_damping_N_s_per_m = 1.0;  // of hand and device together: they have more
  double max_credit_J = 0.002;             // dissipated energy that it sets against what is created later
  double max_debt_J = 0.005;               // created energy that it remembers
  double debt_leak_s = 0.5;                // after which it has forgotten that but for 1/e

  template <class V>
  void visit(V& v) {
    v.field("max_force_N", max_force_N, "largest force on the hand", {0.0, 50.0});
    v.field("max_force_rate_N_per_s", max_force_rate_N_per_s, "fastest change of force", {100.0, 1e6});
    v.field("soft_start_s", soft_start_s, "force grows from zero over this time", {0.0, 60.0});
    v.field("stale_after_s", stale_after_s, "without news from the device for so long, the force ramps to zero",
            {0.001, 1.0});
    v.field("ramp_down_s", ramp_down_s, "duration of every ramp to zero", {0.0, 0.2});
    v.field("passivity", passivity, "damp the energy that the loop creates");
    v.field("max_damping_N_s_per_m", max_damping_N_s_per_m, "largest damping of the passivity controller", {0.0, 50.0});
    v.field("assumed_damping_N_s_per_m", assumed_damping_N_s_per_m, "what hand and device damp at least", {0.0, 1e3});
    v.field("max_credit_J", max_credit_J, "dissipated energy that is set against what is created later", {0.0, 10.0});
    v.field("max_debt_J", max_debt_J, "created energy that is remembered", {0.0, 10.0});
    v.field("debt_leak_s", debt_leak_s, "time constant of forgetting created energy", {0.001, 60.0});
  }
};

}  // namespace asperity
