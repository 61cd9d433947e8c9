#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/device/haptic_device.h"
#include "asperity/device/passivity.h"
#include "asperity/device/safety_config.h"
#include "asperity/device/staleness.h"

namespace asperity {

// What the safety layer remembers from one tick to the next. Plain data; begin with SafetyState{}.
struct SafetyState {
  double gain = 0.0;  // of the soft start and of the ramps to zero, within 0 and 1
  Staleness staleness;
  Stammer stammer;
  Eigen::Vector3d held_N = Eigen::Vector3d::Zero();  // the last finite force that was rendered
  Eigen::Vector3d out_N = Eigen::Vector3d::Zero();   // let through at the tick before
  PassivityState passivity;
  bool plausible = true;  // at the tick before
};

// One tick as the safety layer sees it. Vectors in one set of axes; positions in metres of the hand, not of the scene.
struct SafetyInput {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();    // rendered
  Eigen::Vector3d spring_N = Eigen::Vector3d::Zero();   // the part of it that springs to the proxy give
  Eigen::Vector3d stretch_m = Eigen::Vector3d::Zero();  // from the hand to the proxy
  Eigen::Vector3d hand_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d hand_mps = Eigen::Vector3d::Zero();
  std::uint64_t sequence = 0;  // DeviceReading::sequence
  DeviceStatus status = DeviceStatus::kReady;
  bool scene_changed = false;  // rendered from another snapshot than at the tick before
  bool ending = false;         // ramp to zero, for good
  bool permitted = true;       // else ramp to zero (force_permit.h)
  bool plausible = true;       // else the force that was there before ramps to zero, and begins softly again
  double dt_s = 1e-3;          // since the tick before
  double tick_s = 1e-3;        // between two ticks of the schedule
};

struct SafeForce {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  std::uint32_t limited_by = 0;  // SafetyCause flags
  double dissipated_J = 0.0;     // by the passivity controller at this velocity
  double gain = 0.0;             // of the soft start and of the ramps to zero, within 0 and 1
};

// `config` with its limits lowered to those of the device, where it states any; without the passivity controller for a
// device whose position does not answer to the force, which damping cannot settle.
SafetyConfig lower_to_device(SafetyConfig config, const DeviceInfo& info);

// The force that may reach the hand at this tick, in this order (docs/safety.md): fault, the force limit, the gain
// (non-finite numbers, a stale or implausible position, no permit, the end of the run; soft start), the passivity
// controller's damping, the force limit of the sum, the force-rate limit. For any input, the output is finite,
// at most max_force_N long, and, unless the device has a fault, at most max_force_rate_N_per_s · dt from the force
// before, where dt is dt_s but no more than three ticks. A loop that stood still for longer than stale_after_s begins
// softly again: the hand is elsewhere. Realtime-safe: yes.
SafeForce make_safe(const SafetyConfig& config, SafetyState& state, const SafetyInput& input) noexcept;

// True if nothing is left to ramp down: the next force of an ending run is zero too.
inline bool is_at_rest(const SafetyState& state) noexcept { return state.gain == 0.0 && state.out_N.isZero(0.0); }

}  // namespace asperity
