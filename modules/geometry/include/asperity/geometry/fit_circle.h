#pragma once

#include <span>

#include <Eigen/Core>

namespace asperity {

// A circle through points of a plane.
struct CircleFit {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  double rms_m = 0.0;                                       // radial distance from the circle
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // of centre x, centre y, radius, for independent errors
  int iterations = 0;
  bool converged = false;  // false where the points have no curvature

  double radius_stderr_m() const;
  // Of 1/radius, which is what a short arc determines.
  double curvature_stderr_per_m() const;
};

// The circle with the least sum of squared radial distances (Gauss–Newton with a step control, Gander,
// Golub and Strebel 1994), begun from the algebraic fit of Pratt (1987), which does not favour small
// circles on short arcs. `weights` as in fit_plane. Throws Error for fewer than three points, a wrong
// number of weights, or numbers that are not finite.
CircleFit fit_circle(std::span<const Eigen::Vector2d> points_m, std::span<const double> weights = {});

}  // namespace asperity
