#pragma once

#include <Eigen/Core>

#include "asperity/device/safety_config.h"

namespace asperity {

// What the passivity observer remembers from one tick to the next. Begin with PassivityState{}.
struct PassivityState {
  bool started = false;
  double excess_J = 0.0;  // given by the hand or damped by it, beyond what it got back and what is stored
  double stored_J = 0.0;  // at the tick before
  Eigen::Vector3d hand_m = Eigen::Vector3d::Zero();   // at the tick before
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();  // on the hand since the tick before
};

// The input of one tick. Vectors in one set of axes, metres of the hand.
struct PassivityInput {
  Eigen::Vector3d hand_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d hand_mps = Eigen::Vector3d::Zero();
  double stored_J = 0.0;  // in the renderer's springs, see spring_energy_J()
  bool touching = false;  // a force is rendered
  bool forgive = false;   // created energy has a reason: the scene or the force's scale changed
  double dt_s = 1e-3;
};

// One tick of a time-domain passivity observer and controller: the force to add, against the velocity, so that the
// energy which the loop created is taken back from the hand.
//
// Between two ticks the force is constant, so the energy that the hand gave is exactly E −= f(k−1)·(x(k) − x(k−1))
// with the force that was applied and the displacement that was measured (Ryu, Kim and Hannaford 2004). Observed is
// the excess D = E + B − S over what the springs store (reference energy, Ryu, Preusche, Hannaford and Hirzinger
// 2005); B = Σ b |x(k) − x(k−1)|²/dt is what hand and device damp for certain. If D < 0, the damping α = −D/(dt |v|²) ≤
// max_damping_N_s_per_m takes that energy back within a tick (Hannaford and Ryu 2002). D is kept within −max_debt_J and
// max_credit_J; docs/safety.md states what else is forgotten.
//
// The caller sets `state.force_N` to the force that it commands at last.
// Realtime-safe: yes.
Eigen::Vector3d dissipate_created_energy(const SafetyConfig& config, PassivityState& state,
                                         const PassivityInput& input) noexcept;

// What a spring holds that is stretched by `stretch_m` and pulls with `force_N`, if its force stops growing at
// `max_force_N`: ½ F L, or F_max L (1 − F_max/2F) beyond; F is the force along the stretch, 0 if it does not pull back.
// Realtime-safe: yes.
double spring_energy_J(const Eigen::Vector3d& force_N, const Eigen::Vector3d& stretch_m, double max_force_N) noexcept;

}  // namespace asperity
