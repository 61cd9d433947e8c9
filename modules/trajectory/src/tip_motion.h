#pragma once

#include "asperity/geometry/motion.h"
#include "asperity/trajectory/calibrate_inertial.h"
#include "inertial_smoother.h"

namespace asperity::inertial_smoother {

// The tip's motion at the probe's samples from the accelerometer's: positions, velocities and accelerations
// carried over the lever arm, covariances interpolated between epochs, the force beside them. Takes the samples' states
// out of `smoothed`.
TipMotion make_tip_motion(const InertialStream& inertial, Smoothed& smoothed, const Eigen::Vector3d& tip_in_marker);

}  // namespace asperity::inertial_smoother
