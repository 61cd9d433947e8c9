#pragma once

#include <cstdint>
#include <vector>

#include "asperity/recording/recording.h"
#include "asperity/simulation/simulate_motion.h"

namespace asperity {

// Known forces on the probe one after another, along its axis, as weights or a force gauge give them.
struct ForceSteps {
  std::vector<double> force_N{0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5};
  double hold_s = 0.8;
  double move_s = 0.3;

  double duration_s() const { return static_cast<double>(force_N.size()) * (hold_s + move_s); }
};

MotionFunction force_steps_motion(const ForceSteps& steps, const Pose& T_world_marker,
                                  const Eigen::Vector3d& tip_in_marker_m);

// What a person writes down: for each step the mean of the force's counts over the middle half of its hold.
struct ForceReadings {
  std::vector<double> counts;
  std::vector<double> force_N;
};
// `start_ns`: when the first step began, on the clock of `probe`. Throws Error for a step without a sample.
ForceReadings read_force_steps(const ForceSteps& steps, const ProbeStream& probe, std::int64_t start_ns);

}  // namespace asperity
