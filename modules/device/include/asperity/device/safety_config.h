#pragma once

namespace asperity {

// Limits of what reaches a hand. No scene can raise them; a device's own limits lower them.
struct SafetyConfig {
  double max_force_N = 5.0;
  double max_force_rate_N_per_s = 2000.0;
  double soft_start_s = 0.5;           // force grows from zero over this time after start or a fault
  double stale_after_s = 0.02;         // without news from the device the force ramps to zero
  double ramp_down_s = 0.02;           // of that ramp, and of every other end
  bool passivity = true;               // observe the energy given to the hand and damp what the loop created
  double max_damping_N_s_per_m = 5.0;  // of the passivity controller
};

}  // namespace asperity
