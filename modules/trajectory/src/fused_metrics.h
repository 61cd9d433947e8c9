#pragma once

#include "asperity/recording/calibration.h"
#include "asperity/trajectory/calibrate_inertial.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "inertial_smoother.h"

namespace asperity::inertial_smoother {

// What the last pass used and learnt, by the names of docs/trajectory.md.
void append_learnt(const InertialStream& inertial, const Problem& problem, const Smoothed& smoothed,
                   const Calibration& calibration, const FusedConfig& config, TrajectoryResult& result);

// The noise of the streams as the smoother has learnt it, and the lever that it has estimated.
MotionNoise learnt_noise(const InertialStream& inertial, const Problem& problem, const Smoothed& smoothed,
                         const Calibration& calibration);

}  // namespace asperity::inertial_smoother
