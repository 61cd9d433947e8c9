#include "asperity/calibration/calibrate_imu.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "../src/uniform_basis.h"
#include "asperity/base/error.h"
#include "asperity/calibration/store_imu.h"
#include "asperity/geometry/pose.h"
#include "shaken_probe.h"

namespace asperity {
namespace {

using test::shake;
using test::ShakenProbe;

TEST(UniformBasis, IsThatOfTheFifthDegree) {
  // At a knot the values are 1, 26, 66, 26, 1 over 120 (de Boor, 1978); they sum to one, derivatives to nothing.
  const QuinticBasis knot = quintic_basis(0.0);
  const double expected[] = {1.0, 26.0, 66.0, 26.0, 1.0, 0.0};
  for (std::size_t j = 0; j < 6; ++j) EXPECT_NEAR(knot.value[j], expected[j] / 120.0, 1e-15);
  for (const double share : {0.0, 0.37, 1.0}) {
    const QuinticBasis basis = quintic_basis(share);
    double value = 0.0, first = 0.0, second = 0.0, linear = 0.0, square = 0.0;
    for (std::size_t j = 0; j < 6; ++j) {
      const double at = static_cast<double>(j) - 2.0;
      value += basis.value[j];
      first += basis.first[j];
      second += basis.second[j];
      linear += basis.first[j] * at;
      square += basis.second[j] * at * at;
    }
    EXPECT_NEAR(value, 1.0, 1e-14);
    EXPECT_NEAR(first, 0.0, 1e-14);
    EXPECT_NEAR(second, 0.0, 1e-14);
    EXPECT_NEAR(linear, 1.0, 1e-14);
    EXPECT_NEAR(square, 2.0, 1e-13);
  }
}

// RMS of error over standard error by kind, over many recordings.
struct Ratios {
  double position = 0.0, rotation = 0.0, latency = 0.0;
  double error_mm = 0.0, sigma_mm = 0.0;
  int trials = 0;

  void add(const ImuCalibration& found, const ShakenProbe& probe) {
    const Eigen::Vector3d e_m = found.accelerometer_in_marker_m - probe.lever_m;
    position += e_m.cwiseQuotient(found.position_error_m).squaredNorm() / 3.0;
    // What the calibration gives is in the frame of its own B; shake() puts the sensor's rotation there.
    const Eigen::Vector3d turn = log_rotation(found.R_marker_sensor * expected(probe).conjugate());
    rotation += turn.cwiseQuotient(found.rotation_error_rad).squaredNorm() / 3.0;
    latency += std::pow((found.latency_s - probe.latency_s) / found.latency_error_s, 2);
    error_mm += 1e3 * e_m.norm();
    sigma_mm += 1e3 * found.position_error_m.norm();
    ++trials;
  }
  static Eigen::Quaterniond expected(const ShakenProbe&) { return Eigen::Quaterniond::Identity(); }
  void finish(const char* what) {
    for (double* x : {&position, &rotation, &latency}) *x = std::sqrt(*x / trials);
    std::printf(
        "%s, %d trials: error over sigma: place %.2f, rotation %.2f, latency %.2f; place %.3f mm, sigma %.3f mm\n",
        what, trials, position, rotation, latency, error_mm / trials, sigma_mm / trials);
  }
};

int trials(int few) {
  const char* given = std::getenv("IMU_TRIALS");
  return given ? std::atoi(given) : few;
}

TEST(CalibrateImu, ErrorsAreOfTheSizeThatIsStated) {
  Ratios ratios;
  for (int seed = 0; seed < trials(20); ++seed) {
    Random random(100 + static_cast<std::uint64_t>(seed));
    ShakenProbe probe;
    probe.length_s = 8.0;
    probe.lever_m = {0.05 * random.normal(), 0.05 * random.normal(), 0.05 * random.normal()};
    ratios.add(calibrate_imu(shake(random, probe)), probe);
  }
  ratios.finish("with a gyroscope");
  // 60 and 20 errors: their RMS scatters by 9 % and 16 %.
  EXPECT_GT(ratios.position, 0.75);
  EXPECT_LT(ratios.position, 1.25);
  EXPECT_GT(ratios.rotation, 0.75);
  EXPECT_LT(ratios.rotation, 1.25);
  EXPECT_GT(ratios.latency, 0.6);
  EXPECT_LT(ratios.latency, 1.5);
  EXPECT_LT(ratios.error_mm / ratios.trials, 1.0);
}

TEST(CalibrateImu, WithoutAGyroscope) {
  Ratios ratios;
  for (int seed = 0; seed < trials(8); ++seed) {
    Random random(300 + static_cast<std::uint64_t>(seed));
    ShakenProbe probe;
    probe.gyro = false;
    probe.length_s = 8.0;
    ratios.add(calibrate_imu(shake(random, probe)), probe);
  }
  ratios.finish("without");
  EXPECT_GT(ratios.position, 0.5);
  EXPECT_LT(ratios.position, 1.5);
}

TEST(CalibrateImu, FindsARotationThatNobodyKnows) {
  Random random(400);
  ShakenProbe probe;
  probe.length_s = 10.0;
  probe.R_marker_sensor = exp_rotation({0.4, -1.9, 0.7});
  Recording recording = shake(random, probe);
  // Both sensors are known in their own frame.
  AccelerometerCalibration& accelerometer = recording.calibration.accelerometer;
  const Calibration truth = recording.calibration;
  accelerometer.B = 200.0 * Eigen::Matrix3d::Identity();
  accelerometer.rotation_known = false;
  accelerometer.position_in_marker_m.reset();
  recording.calibration.gyroscope->B = 900.0 * Eigen::Matrix3d::Identity();
  const ImuCalibration imu = calibrate_imu(recording);
  const Eigen::Vector3d turn = log_rotation(imu.R_marker_sensor * probe.R_marker_sensor.conjugate());
  EXPECT_LT(turn.cwiseQuotient(imu.rotation_error_rad).cwiseAbs().maxCoeff(), 4.0);
  EXPECT_LT(turn.norm(), 0.01);
  const Eigen::Vector3d e_m = imu.accelerometer_in_marker_m - probe.lever_m;
  EXPECT_LT(e_m.cwiseQuotient(imu.position_error_m).cwiseAbs().maxCoeff(), 4.0);
  EXPECT_NEAR(imu.latency_s, probe.latency_s, 4.0 * imu.latency_error_s);
  EXPECT_EQ(verdict_word(imu.verdict.verdicts), "valid") << imu.verdict.text;

  Calibration stored = recording.calibration;
  store_imu(imu, recording.calibration, stored);
  EXPECT_TRUE(stored.accelerometer.rotation_known);
  EXPECT_EQ(*stored.accelerometer.position_in_marker_m, imu.accelerometer_in_marker_m);
  EXPECT_GT(stored.accelerometer.position_sigma_m, 0.0);
  // What the stored calibration makes of counts is what the true one makes, within the rotation's error.
  const Eigen::Vector3d counts(900.0, -1500.0, 700.0);
  EXPECT_LT((stored.accelerometer.specific_force_mps2(counts) - truth.accelerometer.specific_force_mps2(counts)).norm(),
            0.1);
  // E is found as a whole, its scale to a fraction of a per cent.
  EXPECT_LT((stored.gyroscope->B - truth.gyroscope->B).norm(), 0.02 * truth.gyroscope->B.norm());
}

TEST(CalibrateImu, TurningAboutOneAxisIsRefused) {
  Random random(401);
  ShakenProbe probe;
  probe.turn_axes = {0.0, 0.0, 1.0};
  try {
    calibrate_imu(shake(random, probe));
    FAIL() << "not refused";
  } catch (const Error& error) {
    // Whether the fit finds the open direction or does not settle at all: refused, with what to do.
    EXPECT_THAT(error.what(), testing::HasSubstr("by some 30° about all its axes"));
    // The axis of the turns, z of the marker, with either sign.
    EXPECT_THAT(error.what(), testing::ContainsRegex("along \\(-?0\\.00, -?0\\.00, -?1\\.00\\) of the marker"));
  }
}

TEST(CalibrateImu, LittleTurningLimits) {
  Random random(402);
  ShakenProbe probe;
  probe.turn_axes = {0.04, 0.04, 1.0};
  const ImuCalibration imu = calibrate_imu(shake(random, probe));
  ASSERT_FALSE(imu.verdict.verdicts.empty());
  EXPECT_EQ(imu.verdict.verdicts[0].code, "imu_place_uncertain");
  EXPECT_TRUE(imu.verdict.trustworthy);
  EXPECT_GT(std::abs(imu.worst_direction.z()), 0.9);
}

TEST(CalibrateImu, PosesFarOffAreLeftOut) {
  Random random(403);
  ShakenProbe probe;
  Recording recording = shake(random, probe);
  for (std::size_t i = 20; i < recording.tracker.size(); i += 61) {
    recording.tracker.T_world_marker[i].translation_m += Eigen::Vector3d(0.02, 0.0, 0.05);
  }
  const ImuCalibration imu = calibrate_imu(recording);
  ASSERT_EQ(imu.problems.size(), 1u);
  EXPECT_GE(imu.problems[0].count, 9u);
  const Eigen::Vector3d e_m = imu.accelerometer_in_marker_m - probe.lever_m;
  EXPECT_LT(e_m.cwiseQuotient(imu.position_error_m).cwiseAbs().maxCoeff(), 4.0);
  EXPECT_LT(e_m.norm(), 2e-3);
}

}  // namespace
}  // namespace asperity
