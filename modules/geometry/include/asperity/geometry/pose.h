#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace asperity {

// A rigid transform T_a_b: maps coordinates in frame b into frame a.
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p_b) const { return rotation * p_b + translation_m; }
  Pose operator*(const Pose& T_b_c) const {
    return {rotation * T_b_c.rotation, rotation * T_b_c.translation_m + translation_m};
  }
  Pose inverse() const {
    const Eigen::Quaterniond back = rotation.conjugate();
    return {back, back * -translation_m};
  }
};

// The rotation by the vector `phi` (axis times angle, rad), exact for small and large angles.
Eigen::Quaterniond exp_rotation(const Eigen::Vector3d& phi);

// The rotation vector of `q`, its angle in [0, π].
Eigen::Vector3d log_rotation(const Eigen::Quaterniond& q);

// The rotation by the least angle that turns the direction of `from` into that of `to`; of opposite ones by π about any
// axis across them.
Eigen::Quaterniond shortest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

// The angle of the rotation that turns `a` into `b`, rad, in [0, π].
double rotation_between_rad(const Pose& a, const Pose& b);

// The matrix with skew(a) b = a × b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

// Linear interpolation, t in [0, 1] (seed A.1).
Eigen::Vector3d lerp(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t);

// Spherical linear interpolation along the shorter arc by the angle between the two quaternions;
// linear and normalised where they nearly coincide (seed A.1, erratum 1).
Eigen::Quaterniond slerp(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double t);

}  // namespace asperity
