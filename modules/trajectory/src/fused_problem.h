#pragma once

#include "asperity/recording/recording.h"
#include "asperity/trajectory/calibrate_inertial.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "inertial_smoother.h"

namespace asperity::inertial_smoother {

// Lays the probe's samples and the tracker's poses, their time moved by `latency_s`, on one time line,
// keeping poses inside the probe's span. Times are seconds after `origin_ns`. Throws Error if fewer
// than four poses remain. The knots are made from `inertial` and `config` when they are asked for: both outlive the
// problem and its copies, and are not changed meanwhile.
Problem make_problem(const Recording& recording, const InertialStream& inertial, const FusedConfig& config,
                     double latency_s, std::int64_t origin_ns);

// The knot of sample `i`, its noise unset; and the noise densities of the segment between the samples i and i + 1.
Knot at_sample(const InertialStream& inertial, std::size_t i, std::int64_t origin_ns);
void set_noise(const InertialStream& inertial, const FusedConfig& config, std::size_t i, Knot& knot);

// The knot at `t_s`, in or beside the interval that ends with sample `after` (1 or more), with its noise.
Knot between_samples(const InertialStream& inertial, const FusedConfig& config, std::size_t after, double t_s,
                     std::int64_t origin_ns);

// Epochs are never further apart: it keeps first-order noise terms exact enough.
inline constexpr double kLongestInterval_s = 0.025;

// The most typical of the poses within a quarter of a second from this epoch on: no wild one.
Pose typical_pose(const Problem& problem, std::size_t epoch);

// A first state from the poses alone, robust against single wild ones; with the rotation marker ←
// sensor from the directions of the specific force where the calibration leaves it open.
Nominal first_guess(const Recording& recording, const Problem& problem);

// The problem's first seconds, if it is at least half as long again; otherwise the whole.
Problem first_stretch(const Problem& problem, double length_s);

// Where the rotation marker ← sensor is unknown: turns the first guess about the direction of gravity, which
// static poses show best, and takes the turn under which the poses of the first seconds are likeliest; the
// same decides whether the gyroscope's axes are the accelerometer's (one chip) or the marker's.
void choose_mounting(Problem& problem, bool has_gyro);

}  // namespace asperity::inertial_smoother
