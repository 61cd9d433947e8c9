#pragma once

#include <limits>
#include <span>

#include <Eigen/Core>

namespace asperity {

// One window of a motion: means under one weight, without differentiating the poses (compare_specific_force.h).
struct MotionWindow {
  Eigen::Vector3d tracker_mps2;     // acceleration by the poses, of the calibrated place of the accelerometer
  Eigen::Vector3d inertial_mps2;    // specific force in the world, plus gravity
  Eigen::Matrix3d rotation;         // the marker's orientation
  Eigen::Matrix3d rotation_per_s2;  // its second derivative
};

struct WindowScale {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double error = kUnknown;      // of the tracker's scale: its motion over the inertial sensors', less 1
  double sigma = kUnknown;      // standard error
  double axes_chi2 = kUnknown;  // of a 3×3 error of its positions, 1 % of each element allowed for
};

// The tracker's scale by least squares over windows that follow one another by half their length:
//   tracker = (1 + e) inertial + R̈ r + R b + c,
// r the error of the accelerometer's place, b its bias, c that of gravity. The noise of the poses is in the left side
// alone, so it does not pull the slope down; the accelerometer's, a window's mean, is small against the motion. The
// standard error is the larger of that of the residuals' variance and of the one that allows for neighbouring windows
// that share half of their data and for residuals that grow with the motion (Newey and West 1987, one lag). Nothing is
// assumed of the sensors' noise, and nothing faster than a window is looked at: what shakes the marker, or filters in
// one of the two sensors, is no scale. nan below 30 degrees of freedom.
WindowScale scale_of_windows(std::span<const MotionWindow> windows);

}  // namespace asperity
