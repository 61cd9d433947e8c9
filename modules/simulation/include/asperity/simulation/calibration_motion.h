#pragma once

#include <cstdint>
#include <vector>

#include "asperity/geometry/pose.h"
#include "asperity/simulation/simulate_motion.h"

namespace asperity {

// Motions by which a probe is calibrated. `tip_in_marker_m` is the true one; all are smooth and deterministic from
// `seed`.

// Stationary in front of the camera.
MotionFunction static_motion(const Pose& T_world_marker, const Eigen::Vector3d& tip_in_marker_m);

struct PivotMotion {
  Eigen::Vector3d p_world_tip_m{0.0, 0.09, 0.34};  // in a dimple
  Eigen::Vector3d mean_rotation_rad{0.15, 0.0, 0.0};
  double swing_rad = 0.3;  // rms about each axis
  double highest_Hz = 0.4;
  double force_N = 1.0;  // along the probe
  std::uint64_t seed = 1;
};
MotionFunction pivot_motion(const PivotMotion& pivot);

// Shaken in the air after `rest_s` of rest, about a pose in view of the camera.
struct ShakeMotion {
  Pose T_world_marker{exp_rotation({0.2, 0.0, 0.0}), {0.0, -0.02, 0.33}};
  double rest_s = 1.0;
  double ramp_s = 0.5;
  double amplitude_m = 0.015;  // rms along each axis
  double rotation_rad = 0.12;  // rms about each axis
  double low_Hz = 0.7;
  double high_Hz = 3.0;
  std::uint64_t seed = 1;
};
MotionFunction shake_motion(const ShakeMotion& shake, const Eigen::Vector3d& tip_in_marker_m);

// Held stationary in one orientation after another, rotated smoothly between.
struct StaticPosesMotion {
  int poses = 30;
  double hold_s = 0.8;
  double move_s = 0.7;
  // Greatest rotation away from the mean orientation; π: any orientation there is.
  double greatest_turn_rad = 3.141592653589793;
  Pose T_world_marker{Eigen::Quaterniond::Identity(), {0.0, -0.02, 0.36}};
  std::uint64_t seed = 1;

  double duration_s() const { return poses * (hold_s + move_s); }
};
MotionFunction static_poses_motion(const StaticPosesMotion& poses, const Eigen::Vector3d& tip_in_marker_m);

// The specific force of a stationary probe, −g in the marker frame, at times `t_ns` of a recording of the bench: what a
// tilting table or a robot that holds the probe knows (thesis §3.5, Freedom 6S; erratum 5).
std::vector<Eigen::Vector3d> static_specific_force_mps2(const Recording& bench, const std::vector<std::int64_t>& t_ns);

}  // namespace asperity
