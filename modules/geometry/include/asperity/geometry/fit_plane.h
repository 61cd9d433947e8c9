#pragma once

#include <span>

#include <Eigen/Core>

namespace asperity {

// A plane through points, with the principal axes of their scatter.
struct PlaneFit {
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();    // columns: largest, middle and least scatter; right-handed
  Eigen::Vector3d scatter_m2 = Eigen::Vector3d::Zero();  // mean square along each axis
  double rms_m = 0.0;                                    // distance from the plane
  Eigen::Vector2d tilt_stderr_rad =
      Eigen::Vector2d::Zero();  // of the normal towards axes 0 and 1, for independent errors

  Eigen::Vector3d normal() const { return axes.col(2); }  // the least scatter; its sign is arbitrary
};

// Least squares plane through at least three points by the singular value decomposition, in their frame.
// `weights`, empty or one a point and not negative, count how often a point was seen: they are scaled
// to a sum of the number of points, so that the standard errors stay those of that many points.
// An undetermined tilt (points on a line) has an infinite standard error. Throws Error for fewer than
// three points, a wrong number of weights, or numbers that are not finite.
PlaneFit fit_plane(std::span<const Eigen::Vector3d> points_m, std::span<const double> weights = {});

}  // namespace asperity
