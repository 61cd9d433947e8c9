#pragma once

#include <span>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"

namespace asperity {

// The rigid motion between two sets of points.
struct AbsoluteOrientation {
  Pose T_b_a;
  double rms_m = 0.0;      // weighted root mean square of |T a - b|
  bool collinear = false;  // the rotation about the points' line is not determined; the smallest one was taken
};

// The pose T_b_a with least sum of w |T a - b|² over pairs of points, in closed form on SO(3): singular value
// decomposition of the pairs' covariance with the determinant checked (Kabsch 1976, Umeyama 1991; thesis §5.4,
// erratum 16). `weights`, empty for all 1 or one a pair, must not be negative. Throws Error for fewer than
// three pairs of positive weight, sizes that differ, numbers that are not finite, or points of one set that
// all coincide.
AbsoluteOrientation absolute_orientation(std::span<const Eigen::Vector3d> a_m, std::span<const Eigen::Vector3d> b_m,
                                         std::span<const double> weights = {});

}  // namespace asperity
