#include "asperity/simulation/tracker_sampler.h"

#include <gtest/gtest.h>

#include <cmath>

#include "asperity/geometry/pose.h"

namespace asperity {
namespace {

// A marker held still in front of the camera for `seconds`.
TrackerSampler hold(SimulationConfig config, const Pose& T_world_marker, double seconds) {
  TrackerSampler tracker(config, 0);
  MotionState state;
  state.q_world_marker = T_world_marker.rotation;
  state.p_world_tip_m = T_world_marker * Eigen::Vector3d(config.probe.tip_in_marker_m.data());
  for (double t_s = 0.0; t_s < seconds; t_s += 0.01) {
    state.t_s = t_s;
    tracker.push(state);
  }
  return tracker;
}

SimulationConfig faultless() {
  SimulationConfig config;
  config.tracker.dropout_chance = 0.0;
  config.tracker.flip_chance = 0.0;
  return config;
}

TEST(TrackerSampler, NoiseIsTheSeedsAtItsDistanceAndGrows) {
  for (const double distance : {1.0, 1.5}) {
    const Pose held{Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, 0.28 * distance)};
    const TrackerSampler tracker = hold(faultless(), held, 60.0);
    Eigen::Vector3d square = Eigen::Vector3d::Zero();
    Eigen::Vector3d turned = Eigen::Vector3d::Zero();
    for (const Pose& pose : tracker.poses.T_world_marker) {
      square += (pose.translation_m - held.translation_m).cwiseAbs2();
      turned += log_rotation(pose.rotation).cwiseAbs2();
    }
    const double n = static_cast<double>(tracker.poses.size());
    ASSERT_NEAR(n, 7200.0, 10.0);
    const Eigen::Vector3d sigma_m = (square / n).cwiseSqrt();
    const Eigen::Vector3d sigma_rad = (turned / n).cwiseSqrt();
    // A standard deviation from 7200 values is right to 0.8 %; four of those.
    EXPECT_NEAR(sigma_m.x() / (0.15e-3 * distance), 1.0, 0.035);
    EXPECT_NEAR(sigma_m.y() / (0.13e-3 * distance), 1.0, 0.035);
    EXPECT_NEAR(sigma_m.z() / (0.54e-3 * distance * distance), 1.0, 0.035);
    EXPECT_NEAR(sigma_rad.x() / (4.4e-3 * distance), 1.0, 0.035);
    EXPECT_NEAR(sigma_rad.z() / (1.5e-3 * distance), 1.0, 0.035);
    EXPECT_NEAR((tracker.rms_position_m() - sigma_m).norm(), 0.0, 0.04 * sigma_m.norm());
  }
}

TEST(TrackerSampler, NoiseGrowsWithTheViewingAngle) {
  const SimulatedTrackerConfig config;
  const Pose facing{Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.28}};
  const Pose turned{exp_rotation({0.0, std::acos(0.5), 0.0}), {0.0, 0.0, 0.28}};
  EXPECT_NEAR(
      (simulated_tracker_noise(config, turned).position_m - 2.0 * simulated_tracker_noise(config, facing).position_m)
          .norm(),
      0.0, 1e-12);
}

TEST(TrackerSampler, StampsCarryTheLatency) {
  SimulationConfig config = faultless();
  config.tracker.clock_jitter_s = 0.0;
  config.tracker.noise_m = {0.0, 0.0, 0.0};
  TrackerSampler tracker(config, 0);
  MotionState state;
  for (double t_s = 0.0; t_s < 2.0; t_s += 1e-3) {
    state.t_s = t_s;
    state.p_world_tip_m = Eigen::Vector3d(0.1 * t_s, 0.10, 0.36);  // 0.1 m/s along x
    tracker.push(state);
  }
  for (std::size_t i = 0; i < tracker.poses.size(); ++i) {
    const double exposed_s = tracker.poses.T_world_marker[i].translation_m.x() / 0.1;
    EXPECT_NEAR(static_cast<double>(tracker.poses.t_ns[i]) * 1e-9 - exposed_s, 0.012, 1e-8);
  }
}

TEST(TrackerSampler, FlippedPoseLooksTheSame) {
  const Pose seen{exp_rotation({0.4, 0.3, 0.2}), {0.03, -0.02, 0.4}};
  const Pose flipped = flipped_pose(seen);
  EXPECT_NEAR(flipped.rotation.norm(), 1.0, 1e-12);
  EXPECT_GT(log_rotation(seen.rotation.conjugate() * flipped.rotation).norm(), 0.5);
  EXPECT_NEAR(log_rotation(seen.rotation.conjugate() * flipped_pose(flipped).rotation).norm(), 0.0, 1e-12);
  // With a focal length of 1000 px the corners of a 40 mm marker move by less than the perspective of its own
  // relief: f (l/d)² / 2 = 5 px of the 100 px that it spans, and none in weak perspective.
  const Eigen::Vector3d ray = seen.translation_m.normalized();
  for (const double x : {-0.02, 0.02}) {
    for (const double y : {-0.02, 0.02}) {
      const Eigen::Vector3d a = seen * Eigen::Vector3d(x, y, 0.0);
      const Eigen::Vector3d b = flipped * Eigen::Vector3d(x, y, 0.0);
      EXPECT_NEAR(((a - b) - ray * ray.dot(a - b)).norm(), 0.0, 1e-15);
      EXPECT_LT(1000.0 * (a.head<2>() / a.z() - b.head<2>() / b.z()).norm(), 5.0);
    }
  }
}

TEST(TrackerSampler, FaultsComeAsOftenAsAsked) {
  SimulationConfig config;
  config.tracker.dropout_chance = 0.01;
  config.tracker.dropout_frames = 4.0;
  config.tracker.flip_chance = 0.01;
  config.tracker.flip_frames = 2.0;
  const Pose held{exp_rotation({0.4, 0.0, 0.0}), {0.0, 0.0, 0.35}};
  const TrackerSampler tracker = hold(config, held, 200.0);
  // Runs are independent, some 230 of each: 4 σ is a quarter.
  const double frames = 24000.0;
  EXPECT_NEAR((frames - static_cast<double>(tracker.poses.size())) / frames, 0.04, 0.012);
  EXPECT_NEAR(static_cast<double>(tracker.flips) / frames, 0.02, 0.006);
  std::int64_t turned = 0;
  for (const Pose& pose : tracker.poses.T_world_marker) {
    turned += log_rotation(held.rotation.conjugate() * pose.rotation).norm() > 0.4;
  }
  EXPECT_EQ(turned, tracker.flips);
}

}  // namespace
}  // namespace asperity
