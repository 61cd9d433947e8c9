#pragma once

// The fakes' mechanics: a mass of 0.2 kg with 40 N s/m, pulled down (−y) by a hand of 1 N. On a wall of 2 N/mm it
// settles with 20 ms, long beside a tick, so a test that is served late still comes to rest.
namespace fake {

struct DampedMass {
  double p_m[3] = {0.0, 0.02, 0.0};
  double v_mps[3] = {0.0, 0.0, 0.0};

  // A millisecond under the motors' force.
  void step(const double (&motor_N)[3]) {
    constexpr double kMass_kg = 0.2, kDamping_N_s_per_m = 40.0, kStep_s = 1e-3;
    const double hand_N[3] = {0.0, -1.0, 0.0};
    for (int i = 0; i < 3; ++i) {
      v_mps[i] += kStep_s * (hand_N[i] + motor_N[i] - kDamping_N_s_per_m * v_mps[i]) / kMass_kg;
      p_m[i] += kStep_s * v_mps[i];
    }
  }
};

}  // namespace fake
