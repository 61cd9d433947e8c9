#pragma once

#include <functional>
#include <string>

#include "asperity/base/progress.h"
#include "asperity/recording/recording.h"
#include "asperity/simulation/probe_motion.h"
#include "asperity/simulation/simulation_config.h"

namespace asperity {

// The probe's true state at a time from 0 on, s. Twice continuously differentiable, or the accelerometer sees steps.
using MotionFunction = std::function<MotionState(double t_s)>;

// A recording of any motion: the probe's counts, tracked poses, the truth and the exact calibration. The surface, hand
// and shape of `config` are not used; one segment, named `object`. The same config and motion give the same recording.
// Throws Error for more than half an hour or a probe faster than one sample a step, and Cancelled.
Recording simulate_motion(const SimulationConfig& config, const MotionFunction& motion, double duration_s,
                          const std::string& object, const Observer& observer = {});

// `config` with a link and a clock that lose, delay and corrupt nothing, and an exact calibration: what the probe
// itself knows, before its bytes go on their way.
SimulationConfig without_link_faults(const SimulationConfig& config);

}  // namespace asperity
