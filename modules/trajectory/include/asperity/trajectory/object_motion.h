#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"

namespace asperity {

// A rigid body at one instant, world axes throughout.
struct ObjectState {
  Pose T_world_object;
  Eigen::Vector3d v_mps = Eigen::Vector3d::Zero();          // of the object's origin
  Eigen::Vector3d omega_radps = Eigen::Vector3d::Zero();    // angular velocity
  Eigen::Vector3d a_mps2 = Eigen::Vector3d::Zero();         // of the origin
  Eigen::Vector3d alpha_radps2 = Eigen::Vector3d::Zero();   // angular acceleration
  Eigen::Matrix3d position_m2 = Eigen::Matrix3d::Zero();    // covariance of the origin
  Eigen::Matrix3d rotation_rad2 = Eigen::Matrix3d::Zero();  // of the rotation vector φ, R_true = exp(φ) R
};

// What is smoothed at one pose of the tracker: position or rotation with its rate, and the covariances of (value, rate)
// here and between here and the next pose.
struct ObjectKnot {
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> with_next = Eigen::Matrix<double, 6, 6>::Zero();  // E[δx_k δx_{k+1}ᵀ]
};

// What the poses have shown of their noise and of the motion, world axes, x y z.
struct ObjectNoise {
  Eigen::Vector3d accel_m2ps3 = Eigen::Vector3d::Zero();      // white acceleration of the motion, two-sided density
  Eigen::Vector3d angular_rad2ps3 = Eigen::Vector3d::Zero();  // white angular acceleration
  Eigen::Vector3d pose_m = Eigen::Vector3d::Zero();           // standard deviation of one pose, RMS over all
  Eigen::Vector3d pose_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d slow_m = Eigen::Vector3d::Zero();  // of the tracker's slow error
  Eigen::Vector3d slow_rad = Eigen::Vector3d::Zero();
  double slow_time_s = 1.0;
  double frame_s = 0.0;  // mean time between poses, gaps left out
};

// The smoothed motion of a tracked body (smooth_object_motion.h; docs/moving-object.md).
struct ObjectMotion {
  std::vector<std::int64_t> t_ns;  // of the poses, on the probe's clock
  std::vector<Pose> T_world_object;
  std::vector<ObjectKnot> position;
  std::vector<ObjectKnot> rotation;
  ObjectNoise noise;
  double longest_gap_s = 0.0;  // over a longer one nothing is interpolated
  std::size_t outlying = 0;    // poses that lost most of their weight

  std::size_t size() const { return t_ns.size(); }
  // Between the first and the last pose, and in no gap.
  bool is_seen(std::int64_t t_ns) const;
  // The conditional mean between two poses: cubic in position and rotation vector. At the ends' values outside of the
  // poses. Needs at least two poses.
  ObjectState at(std::int64_t t_ns) const;
};

}  // namespace asperity
