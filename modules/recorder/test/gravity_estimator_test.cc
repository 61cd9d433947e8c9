#include "asperity/recorder/gravity_estimator.h"

#include <gmock/gmock.h>

#include <cmath>

#include "asperity/base/random.h"
#include "asperity/base/units.h"

namespace asperity {
namespace {

constexpr double kCountsPerMps2 = 200.0;
constexpr double kNoise_mps2 = 0.05;

Calibration calibration_of(double latency_s = 0.0) {
  Calibration out;
  out.accelerometer.B = kCountsPerMps2 * Eigen::Matrix3d::Identity();
  out.accelerometer.C = {10.0, -20.0, 30.0};
  out.tracker.latency_s = latency_s;
  return out;
}

struct Bench {
  Calibration calibration = calibration_of();
  Eigen::Vector3d gravity_world_mps2{0.0, kStandardGravity_mps2, 0.0};
  Random random{3};

  Eigen::Vector3d noise(double sigma) {
    return sigma * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }

  // At 1 kHz and 100 Hz from `start_s`: rotation R(t), position p(t), acceleration a(t) in the world.
  template <class R, class P, class A>
  void feed(GravityEstimator& estimator, double start_s, double duration_s, const R& rotation, const P& position,
            const A& acceleration) {
    const auto steps = static_cast<int>(duration_s * 1000.0);
    for (int i = 0; i < steps; ++i) {
      const double t_s = start_s + 1e-3 * i;
      const auto t_ns = static_cast<std::int64_t>(std::llround(t_s * 1e9));
      // Specific force f = a − g, turned into the marker frame (erratum 5).
      const Eigen::Vector3d f_marker =
          rotation(t_s).conjugate() * (acceleration(t_s) - gravity_world_mps2) + noise(kNoise_mps2);
      estimator.add_probe(t_ns, calibration.accelerometer.counts(f_marker));
      if (i % 10 != 0) continue;
      const Pose pose{exp_rotation(noise(2e-3)) * rotation(t_s), position(t_s) + noise(1e-4)};
      estimator.add_pose(t_ns + static_cast<std::int64_t>(calibration.tracker.latency_s * 1e9), pose);
    }
  }
};

Eigen::Vector3d nothing(double) { return Eigen::Vector3d::Zero(); }

TEST(GravityEstimator, MeasuresGravityInTheWorldForAnyPose) {
  Bench bench;
  bench.calibration.tracker.latency_s = 0.03;
  bench.gravity_world_mps2 = exp_rotation({0.2, 0.0, -0.3}) * Eigen::Vector3d(0.0, 9.81, 0.0);
  GravityEstimator estimator({}, bench.calibration);
  EXPECT_FALSE(estimator.estimate().measured);
  for (int pose = 0; pose < 6; ++pose) {
    const Eigen::Quaterniond rotation = exp_rotation({0.5 * pose, 1.0, -0.4 * pose});
    bench.feed(
        estimator, 2.0 * pose, 1.0, [&](double) { return rotation; }, nothing, nothing);
  }
  estimator.finish();
  const GravityEstimate found = estimator.estimate();
  EXPECT_TRUE(found.measured);
  EXPECT_EQ(found.windows, 24);
  // A window: 250 samples of 0.05 m/s² and 25 poses of 2 mrad, which turn 9.81 m/s² by 4 mm/s².
  const double window_sigma_mps2 = std::hypot(kNoise_mps2 / std::sqrt(250.0), 2e-3 * 9.81 / 5.0);
  EXPECT_LT((found.gravity_world_mps2 - bench.gravity_world_mps2).norm(),
            4.0 * window_sigma_mps2 / std::sqrt(24.0) * 1.8);
  EXPECT_GT(found.scatter_mps2.maxCoeff(), 0.5 * window_sigma_mps2);
  EXPECT_LT(found.scatter_mps2.maxCoeff(), 2.0 * window_sigma_mps2);
}

TEST(GravityEstimator, MotionIsNotRest) {
  Bench bench;
  GravityEstimator estimator({}, bench.calibration);
  const Eigen::Quaterniond still = Eigen::Quaterniond::Identity();
  const auto fixed = [&](double) { return still; };
  // A stroke of 25 mm/s over a texture; a turn of 0.2 rad/s; a shake.
  bench.feed(
      estimator, 0.0, 2.0, fixed, [](double t) { return Eigen::Vector3d(0.025 * t, 0.0, 0.0); }, nothing);
  bench.feed(
      estimator, 2.0, 2.0,
      [](double t) {
        return exp_rotation({0.0, 0.6 * t, 0.0});
      },
      nothing, nothing);
  bench.feed(estimator, 4.0, 2.0, fixed, nothing,
             [](double t) { return Eigen::Vector3d(2.0 * std::sin(60.0 * t), 0.0, 0.0); });
  estimator.finish();
  EXPECT_EQ(estimator.estimate().windows, 0);
  EXPECT_FALSE(estimator.estimate().measured);
}

TEST(GravityEstimator, ANonsenseMagnitudeIsNotBelieved) {
  Bench bench;
  bench.gravity_world_mps2 = {0.0, 6.0, 0.0};
  GravityEstimator estimator({}, bench.calibration);
  bench.feed(
      estimator, 0.0, 1.0, [](double) { return Eigen::Quaterniond::Identity(); }, nothing, nothing);
  estimator.finish();
  EXPECT_FALSE(estimator.estimate().measured);
  EXPECT_TRUE(estimator.estimate().implausible);
}

TEST(GravityEstimator, NeedsToKnowHowTheSensorIsTurned) {
  Bench bench;
  bench.calibration.accelerometer.rotation_known = false;
  GravityEstimator estimator({}, bench.calibration);
  bench.feed(
      estimator, 0.0, 1.0, [](double) { return Eigen::Quaterniond::Identity(); }, nothing, nothing);
  estimator.finish();
  EXPECT_EQ(estimator.estimate().windows, 0);
}

TEST(GravityEstimator, OneStreamAloneMeasuresNothingAndKeepsNothing) {
  Bench bench;
  GravityEstimator estimator({}, bench.calibration);
  for (std::int64_t i = 0; i < 100'000; ++i) estimator.add_probe(1'000'000 * i, {0.0, -9.8 * kCountsPerMps2, 0.0});
  for (std::int64_t i = 0; i < 100; ++i) estimator.add_pose(10'000'000 * i, {});
  estimator.finish();
  EXPECT_EQ(estimator.estimate().windows, 0);
}

}  // namespace
}  // namespace asperity
