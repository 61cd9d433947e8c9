#pragma once

#include "asperity/geometry/motion.h"
#include "asperity/trajectory/calibrate_inertial.h"
#include "inertial_smoother.h"

namespace asperity::inertial_smoother {

// The tip's motion at the probe's samples from the accelerometer's: positions, velocities and accelerations
// carried over the lever arm, covariances interpolated between epochs, the force beside them.
TipMotion make_tip_motion(const InertialStream& inertial, const Smoothed& smoothed,
                          const Eigen::Vector3d& tip_in_marker);

}  // namespace asperity::inertial_smoother
