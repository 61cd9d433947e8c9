#include "asperity/calibration/calibrate_accelerometer_field.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "coverage.h"
#include "simulated_accelerometer.h"

namespace asperity {
namespace {

constexpr int kTrials = 200;

using test::SimulatedAccelerometer;
using testing::HasSubstr;

constexpr double kGravity_mps2 = kStandardGravity_mps2;

std::vector<Eigen::Vector3d> directions(int count, Random& random) {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < count; ++i) out.push_back(test::random_direction(random));
  return out;
}

// Axes within a few degrees of square and scales within some per cent of each other; lower triangular.
SimulatedAccelerometer draw_sensor(double scale, double offset, Random& random) {
  SimulatedAccelerometer out;
  out.B.setZero();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < row; ++column) out.B(row, column) = scale * random.uniform(-0.05, 0.05);
    out.B(row, row) = scale * random.uniform(0.95, 1.05);
    out.C[row] = offset + scale * random.uniform(-1.0, 1.0);
  }
  return out;
}

std::string message_of(const AccelerometerSamples& samples) {
  try {
    calibrate_accelerometer_field(samples);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void recover(const std::string& name, double scale, double offset, double drift, double noise) {
  test::Coverage coverage;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(21, static_cast<std::uint64_t>(trial));
    SimulatedAccelerometer sensor = draw_sensor(scale, offset, random);
    sensor.drift_counts = drift;
    sensor.noise_counts = noise;
    const auto samples = test::hold_in(directions(30, random), kGravity_mps2, sensor, random);
    const AccelerometerFieldResult result = calibrate_accelerometer_field(samples);
    const Eigen::Vector3d length = sensor.B.rowwise().norm();
    const Eigen::Matrix3d unit = length.cwiseInverse().asDiagonal() * sensor.B;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string letter(1, "ijk"[axis]);
      coverage.add("scale " + letter, result.scale_counts_per_mps2[axis], length[axis], result.scale_stderr[axis]);
      coverage.add("bias " + letter, result.accelerometer.C[axis], sensor.C[axis], result.bias_stderr_counts[axis]);
      for (int column = 0; column <= axis; ++column) {
        coverage.add("B " + letter + std::string(1, "xyz"[column]), result.accelerometer.B(axis, column),
                     sensor.B(axis, column), result.accelerometer.standard_errors(axis, column));
      }
    }
    int pair = 0;
    for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
      coverage.add("angle " + std::to_string(pair), result.misalignment_rad[pair],
                   std::asin(unit.row(a).dot(unit.row(b))), result.misalignment_stderr_rad[pair]);
      ++pair;
    }
  }
  coverage.expect(name, kTrials);
}

TEST(CalibrateAccelerometerField, TwoHundredSixteenBitSensorsKeepTheirErrors) {
  recover("accelerometer in the field, 16 bit, 30 poses", 415.0, 32768.0, 1.5, 4.0);
}

TEST(CalibrateAccelerometerField, TwoHundredEightBitSensorsKeepTheirErrors) {
  recover("accelerometer in the field, 8 bit, 30 poses", 5.7, 120.0, 0.05, 0.6);
}

TEST(CalibrateAccelerometerField, LeavesOutPosesThatWereNotStill) {
  Random random(4);
  const SimulatedAccelerometer sensor = draw_sensor(415.0, 32768.0, random);
  auto samples = test::hold_in(directions(36, random), kGravity_mps2, sensor, random);
  const StaticPoses found = find_static_poses(samples);
  ASSERT_GE(found.poses.size(), 34U);
  // A steady push of 0.3 m/s² while three poses were recorded: still to the detector, but not gravity.
  for (const std::size_t p : {3U, 12U, 20U}) {
    for (std::size_t i = found.poses[p].first; i < found.poses[p].last; ++i) {
      samples.counts[i] += 0.03 * (found.poses[p].mean_counts - sensor.C);
    }
  }
  const AccelerometerFieldResult result = calibrate_accelerometer_field(samples);
  EXPECT_EQ(result.poses.size() - result.used, 3U);
  for (const std::size_t p : {3U, 12U, 20U}) EXPECT_FALSE(result.poses[p].used);
  EXPECT_TRUE(result.verdict.trustworthy) << result.verdict.text;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(result.scale_counts_per_mps2[axis], sensor.B.row(axis).norm(), 4.0 * result.scale_stderr[axis]);
  }
}

TEST(CalibrateAccelerometerField, NoiseFreeReadingsGiveTheExactModel) {
  Random random(9);
  SimulatedAccelerometer sensor = draw_sensor(1e6, 0.0, random);
  sensor.drift_counts = 0.0;
  sensor.noise_counts = 0.0;
  const auto result =
      calibrate_accelerometer_field(test::hold_in(directions(20, random), kGravity_mps2, sensor, random));
  // Rounding to whole counts is all that is left.
  EXPECT_LT((result.accelerometer.B - sensor.B).norm(), 2.0);
  EXPECT_LT(result.rms_mps2, 1e-6);
}

TEST(CalibrateAccelerometerField, RefusesWhatDoesNotDetermineIt) {
  Random random(6);
  const SimulatedAccelerometer sensor = draw_sensor(415.0, 32768.0, random);
  const auto tell = [&](const std::vector<Eigen::Vector3d>& held) {
    return message_of(test::hold_in(held, kGravity_mps2, sensor, random));
  };
  EXPECT_THAT(tell(directions(5, random)), HasSubstr("12 are needed"));

  std::vector<Eigen::Vector3d> alike;
  for (int i = 0; i < 30; ++i)
    alike.push_back((Eigen::Vector3d::UnitZ() + 0.02 * test::random_direction(random)).normalized());
  EXPECT_THAT(tell(alike), HasSubstr("hardly differ along the sensor's k axis"));

  std::vector<Eigen::Vector3d> in_a_plane;
  for (int i = 0; i < 30; ++i) in_a_plane.push_back({std::cos(0.21 * i), std::sin(0.21 * i), 0.0});
  EXPECT_THAT(tell(in_a_plane), HasSubstr("k up"));

  std::vector<Eigen::Vector3d> cone;
  for (int i = 0; i < 30; ++i)
    cone.push_back(Eigen::Vector3d(0.3 * std::cos(2.1 * i), 0.3 * std::sin(2.1 * i), 1.0).normalized());
  EXPECT_THAT(tell(cone), HasSubstr("k down"));

  AccelerometerSamples still;
  for (int i = 0; i < 5000; ++i) {
    still.t_s.push_back(0.01 * i);
    still.counts.push_back(sensor.read({0.0, 0.0, 9.8}, Eigen::Vector3d::Zero(), random));
  }
  EXPECT_THAT(message_of(still), HasSubstr("poses"));
}

}  // namespace
}  // namespace asperity
