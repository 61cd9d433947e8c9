#pragma once

#include <array>
#include <cstdint>

#include "asperity/base/random.h"
#include "asperity/recording/recording.h"
#include "asperity/simulation/gauss_markov.h"
#include "asperity/simulation/probe_motion.h"
#include "asperity/simulation/tracker_config.h"

namespace asperity {

// Standard deviations of a tracked pose along the ray's own axes: right, down, along the ray. Across the
// ray they grow with the distance, along it with its square; all with the marker's foreshortening.
struct SimulatedTrackerNoise {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
  Eigen::Matrix3d world_from_ray = Eigen::Matrix3d::Identity();  // its columns are the ray's axes
};
SimulatedTrackerNoise simulated_tracker_noise(const SimulatedTrackerConfig& config, const Pose& T_world_marker);

// The other pose of a flat marker with nearly the same image: its relief mirrored in depth about the
// plane across the viewing ray (Schweighofer and Pinz, 2006, in weak perspective).
Pose flipped_pose(const Pose& T_world_marker);

// Turns the true motion into tracked poses, state by state.
class TrackerSampler {
 public:
  // The marker's origin is found from the tip by `tip_in_marker_m`.
  // With `other_errors` above 0: in the same frames, with the same stamps, another body whose errors and losses are its
  // own.
  TrackerSampler(const SimulationConfig& config, std::int64_t start_ns, std::uint64_t other_errors = 0);

  void push(const MotionState& state);

  TrackerStream poses;
  std::int64_t flips = 0;

  // Root mean square noise over all frames along the world's axes.
  Eigen::Vector3d rms_position_m() const;
  Eigen::Vector3d rms_rotation_rad() const;

 private:
  void take(const Pose& T_world_marker, double t_s);
  // The marker on its springy mount, one step of the integration later.
  Pose shake(const Pose& T_world_marker, double t_s);

  SimulatedTrackerConfig config_;
  Eigen::Vector3d tip_in_marker_m_;
  std::int64_t start_ns_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t lost_left_ = 0;
  std::int64_t flipped_left_ = 0;
  double phase_ = 0.0;
  bool has_previous_ = false;
  double previous_t_s_ = 0.0;
  Pose previous_;
  Eigen::Vector3d sum_position_m2_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum_rotation_rad2_ = Eigen::Vector3d::Zero();
  Random noise_, clock_, faults_;
  Random slow_random_, wander_random_;
  GaussMarkov wander_;
  std::array<GaussMarkov, 6> slow_;

  int held_ = 0;  // rigid poses before this one, of the mount's acceleration
  double held_t_s_ = 0.0;
  Eigen::Vector3d held_m_ = Eigen::Vector3d::Zero(), held_v_mps_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d bend_m_ = Eigen::Vector3d::Zero(), bend_v_mps_ = Eigen::Vector3d::Zero();
};

}  // namespace asperity
