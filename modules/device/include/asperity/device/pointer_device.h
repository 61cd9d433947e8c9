#pragma once

#include <memory>

#include <Eigen/Core>

#include "asperity/device/haptic_device.h"
#include "asperity/device/latest_value.h"

namespace asperity {

// The target of a pointer (a mouse, a pen) for the device point, in the device's axes, in metres. Published by one
// other thread; repeatedly also while the pointer is stationary, because silence is a stall.
using PointerTargets = LatestValue<Eigen::Vector3d>;

// A pointer that stands for a haptic device: it pulls a small, damped mass by a spring, and the force acts on the mass.
struct PointerDeviceConfig {
  double mass_kg = 0.05;
  double stiffness_N_per_m = 300.0;  // of the spring between pointer and point; fingers have 200 to 800
  double damping_N_s_per_m = 5.0;    // of the mass against rest
  double smoothing_s = 0.015;        // a pointer comes in steps of a frame; the spring's end follows it in this time
  double reach_m = 0.03;             // the spring's end is never farther from the point: its pull has a limit
  double stalled_after_s = 0.25;     // without a target
  double max_force_N = 20.0;         // as of the modelled hand: it stands for no product
  double max_stiffness_N_per_m = 5000.0;
  double rate_Hz = 1000.0;  // at which it wants to be served

  template <class V>
  void visit(V& v) {
    v.field("mass_kg", mass_kg, "mass of the device point, kg", {0.01, 10.0});
    v.field("stiffness_N_per_m", stiffness_N_per_m, "spring between pointer and point, N/m", {1.0, 1e4});
    v.field("damping_N_s_per_m", damping_N_s_per_m, "damping of the point, N s/m", {0.1, 1e3});
    v.field("smoothing_s", smoothing_s, "time in which the spring's end follows the pointer, s", {1e-3, 1.0});
    v.field("reach_m", reach_m, "longest stretch of the spring, m", {1e-4, 1.0});
    v.field("stalled_after_s", stalled_after_s, "without news of the pointer for so long it is stalled, s",
            {0.02, 2.0});
    v.field("max_force_N", max_force_N, "largest force on the point, N", {0.1, 1000.0});
    v.field("max_stiffness_N_per_m", max_stiffness_N_per_m, "stiffest wall it claims to render, N/m", {1.0, 1e6});
    v.field("rate_Hz", rate_Hz, "at which it wants to be served, Hz", {100.0, 4000.0});
  }
};

// The device point begins at `start_m`, stationary, and stays there until the first target. With u the newest target,
// held within `reach_m` of the point p, g the spring's end and f the force written last:
//
//   m p″ + b p′ + k (p − g) = f,    g′ = (u − g) / smoothing_s
//
// Between two ticks u and f are constant, so both are advanced exactly, by the matrix exponential. The same targets and
// forces at the same ticks give the same bits. A target that is not finite is none. Readings are kStalled if no target
// came for longer than stalled_after_s, kEnded after close(). Throws Error for a config out of its ranges, a start that
// is not finite, and no targets.
std::unique_ptr<HapticDevice> open_pointer(const PointerDeviceConfig& config, const Eigen::Vector3d& start_m,
                                           std::shared_ptr<PointerTargets> targets);

}  // namespace asperity
