#include "asperity/trajectory/estimate_trajectory_thesis.h"

#include <gtest/gtest.h>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/signal/statistics.h"

namespace asperity {
namespace {

constexpr double kSpeed_mps = 0.025;
constexpr double kHeight_m = 50e-6;
constexpr double kRate_radps = 2.0 * M_PI * 10.0;
const Eigen::Vector3d kTip_in_marker_m(0.0, 0.1, 0.01);

Eigen::Vector3d tip_at(double t) { return {kSpeed_mps * t, kHeight_m * std::sin(kRate_radps * t), 0.3}; }
Eigen::Quaterniond orientation_at(double t) { return exp_rotation({0.3, 0.1 + 0.02 * std::sin(t), 0.1}); }

// A tip that goes along x at 25 mm/s and up and down by 50 µm at 10 Hz, its accelerometer at the tip.
Recording make_recording(double tracker_noise) {
  Random random(1);
  Recording r;
  r.info.gravity_world_mps2 = {0.0, 9.80665, 0.0};
  r.calibration.accelerometer.B = 400.0 * Eigen::Matrix3d::Identity();
  r.calibration.accelerometer.C = {10.0, -20.0, 30.0};
  r.calibration.force.newton_per_count = 0.01;
  r.calibration.force.offset_newton = 0.1;
  r.calibration.tip_in_marker_m = kTip_in_marker_m;
  r.calibration.tracker.latency_s = 0.02;
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.001 * i;
    const Eigen::Vector3d a(0.0, -kHeight_m * kRate_radps * kRate_radps * std::sin(kRate_radps * t), 0.0);
    const Eigen::Vector3d f = orientation_at(t).conjugate() * (a - r.info.gravity_world_mps2);
    r.probe.t_ns.push_back(1'000'000LL * i + 7'000'000'000'000LL);
    r.probe.accel_counts.push_back(r.calibration.accelerometer.B * f + r.calibration.accelerometer.C);
    r.probe.force_counts.push_back(i % 10 == 0 ? 100.0 * t : std::nan(""));
  }
  for (int i = 0; i < 180; ++i) {
    const double t = static_cast<double>(i) / 45.0;
    Pose T{orientation_at(t), Eigen::Vector3d::Zero()};
    T.translation_m = tip_at(t) - T.rotation * kTip_in_marker_m;
    const auto& sigma = r.calibration.tracker.sigma_position_m;
    for (int k = 0; k < 3; ++k) T.translation_m[k] += tracker_noise * sigma[k] * random.normal();
    r.tracker.T_world_marker.push_back(T);
    r.tracker.t_ns.push_back(static_cast<std::int64_t>((t + 0.02) * 1e9) + 7'000'000'000'000LL);
  }
  return r;
}

double time_s(const TipMotion& motion, std::size_t i) {
  return static_cast<double>(motion.t_ns[i] - 7'000'000'000'000LL) * 1e-9;
}

TEST(EstimateTrajectoryThesis, FollowsAKnownMotion) {
  const TrajectoryResult result = estimate_trajectory_thesis(make_recording(0.0), {});
  const TipMotion& motion = result.motion;
  ASSERT_GT(motion.size(), 780u);
  EXPECT_TRUE(result.trustworthy);
  EXPECT_NEAR(result.metrics.at("scan_speed_mps"), kSpeed_mps, 1e-4);
  for (std::size_t i = 200; i < motion.size(); ++i) {
    const double t = time_s(motion, i);
    EXPECT_EQ(motion.t_ns[i] - motion.t_ns[i - 1], 5'000'000);
    EXPECT_NEAR((motion.p_world_tip_m[i] - tip_at(t)).norm(), 0.0, 60e-6);  // the texture itself is not followed
    EXPECT_NEAR(motion.p_world_tip_m[i].x(), tip_at(t).x(), 30e-6);
    EXPECT_NEAR(motion.v_world_tip_mps[i].x(), kSpeed_mps, 0.5e-3);
    EXPECT_NEAR(motion.force_N[i], t + 0.1, i + 5 < motion.size() ? 1e-6 : 0.02);
    // The orientation lags by some 20 ms of its 0.02 rad/s: 4 mm/s² of gravity; interpolation 0.2 %.
    const double a = -kHeight_m * kRate_radps * kRate_radps * std::sin(kRate_radps * t);
    EXPECT_NEAR(motion.a_world_tip_mps2[i].y(), a, 0.006);
  }
  EXPECT_TRUE(motion.cov_world_tip_m2.empty());
}

// Only the difference of the two latencies moves the streams; the output's times lose the probe's.
TEST(EstimateTrajectoryThesis, TakesOffTheProbesLatency) {
  Recording r = make_recording(0.0);
  const TrajectoryResult prompt = estimate_trajectory_thesis(r, {});
  constexpr std::int64_t kLate_ns = 8'000'000;
  r.calibration.probe_latency_s = 8e-3;
  for (auto& t_ns : r.probe.t_ns) t_ns += kLate_ns;
  const TrajectoryResult late = estimate_trajectory_thesis(r, {});
  ASSERT_EQ(late.motion.size(), prompt.motion.size());
  for (std::size_t i = 0; i < late.motion.size(); ++i) {
    EXPECT_EQ(late.motion.t_ns[i], prompt.motion.t_ns[i]);
    EXPECT_NEAR((late.motion.p_world_tip_m[i] - prompt.motion.p_world_tip_m[i]).norm(), 0.0, 1e-9);
  }
}

// The filter must be worth having: less noise than the tracker's interpolated poses.
TEST(EstimateTrajectoryThesis, LowersTheTrackersNoise) {
  const TrajectoryResult result = estimate_trajectory_thesis(make_recording(1.0), {});
  std::vector<double> error_m;
  for (std::size_t i = 100; i < result.motion.size(); ++i) {
    error_m.push_back(result.motion.p_world_tip_m[i].z() - 0.3);
  }
  EXPECT_LT(rms(error_m), 0.54e-3 * 0.7);
}

TEST(EstimateTrajectoryThesis, SaysWhenTheMarkerWasLost) {
  Recording r = make_recording(0.0);
  r.tracker.t_ns.erase(r.tracker.t_ns.begin() + 50, r.tracker.t_ns.begin() + 90);
  r.tracker.T_world_marker.erase(r.tracker.T_world_marker.begin() + 50, r.tracker.T_world_marker.begin() + 90);
  const TrajectoryResult result = estimate_trajectory_thesis(r, {});
  EXPECT_FALSE(result.trustworthy);
  EXPECT_NEAR(result.metrics.at("longest_tracker_gap_s"), 41.0 / 45.0, 1e-6);
  r.tracker = {};
  EXPECT_THROW(estimate_trajectory_thesis(r, {}), Error);
}

}  // namespace
}  // namespace asperity
