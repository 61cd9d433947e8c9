#pragma once

#include <Eigen/Geometry>

namespace second_bench {

// The rotation by a rotation vector, rad.
inline Eigen::Quaterniond turn_by(const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  if (angle < 1e-12) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_rad / angle));
}

}  // namespace second_bench
