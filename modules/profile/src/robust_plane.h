#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/geometry/fit_plane.h"

namespace asperity {

constexpr double kDegreeOfFit_rad = std::numbers::pi / 180.0;

// The plane through the coarse points that most of them agree on: first by the sum of distances, then by Tukey's
// weights, so that an approach without a force sensor to mark it does not tilt it. `weights` become Tukey's.
PlaneFit fit_robust_plane(const std::vector<Eigen::Vector3d>& points_m, double error_m, std::vector<double>& weights);

inline double angle_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace asperity
