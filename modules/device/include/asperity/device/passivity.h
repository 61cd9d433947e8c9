#pragma once

#include <Eigen/Core>

#include "asperity/device/safety_config.h"

namespace asperity {

// What the passivity observer remembers from one tick to the next. Begin with PassivityState{}.
struct PassivityState {
  bool started = false;
  double energy_J = 0.0;  // that the hand has given to the loop and not got back; negative: the loop created it
  Eigen::Vector3d hand_m = Eigen::Vector3d::Zero();   // at the tick before
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();  // on the hand since the tick before
};

// What one tick tells it. Vectors in one set of axes, metres of the hand.
struct PassivityInput {
  Eigen::Vector3d hand_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d hand_mps = Eigen::Vector3d::Zero();
  bool touching = false;  // a force is rendered
  bool forgive = false;   // created energy has a reason: the scene or the force's scale changed
  double dt_s = 1e-3;
};

// One tick of a time-domain passivity observer and controller: the force to add, against the velocity, so that the
// energy which the loop created is taken back from the hand.
//
// Between two ticks the force is constant, so the energy that the hand gave is exactly E −= f(k−1)·(x(k) − x(k−1))
// with the force that was applied and the displacement that was measured (Ryu, Preusche, Hannaford and Hirzinger
// 2005). If E < 0, the damping α = −E/(dt |v|²) ≤ max_damping_N_s_per_m takes that energy back within a tick
// (Hannaford and Ryu 2002). What is stored and forgotten is told in docs/safety.md.
//
// The caller sets `state.force_N` to the force that it commands at last.
// Realtime-safe: yes.
Eigen::Vector3d damp_created_energy(const SafetyConfig& config, PassivityState& state,
                                    const PassivityInput& input) noexcept;

}  // namespace asperity
