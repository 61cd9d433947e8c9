#pragma once

#include "asperity/recording/recording.h"
#include "asperity/trajectory/fused.h"
#include "asperity/trajectory/inertial.h"
#include "inertial_smoother.h"

namespace asperity::inertial_smoother {

// Lays the probe's samples and the tracker's poses, their time moved by `latency_s`, on one time line,
// keeping poses inside the probe's span. Times are seconds after `origin_ns`. Throws Error if fewer
// than four poses remain.
Problem make_problem(const Recording& recording, const InertialStream& inertial, const FusedConfig& config,
                     double latency_s, std::int64_t origin_ns);

// A first state from the poses alone, robust against single wild ones; with the rotation marker ←
// sensor from the directions of the specific force where the calibration leaves it open.
Nominal first_guess(const Recording& recording, const Problem& problem);

}  // namespace asperity::inertial_smoother
