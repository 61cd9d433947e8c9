#include "asperity/simulation/probe_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/simulation/low_pass.h"
#include "asperity/simulation/probe_truth.h"

namespace asperity {
namespace {

double gain(double cutoff_Hz, int poles, double frequency_Hz) {
  constexpr double kRate_Hz = 40000.0;
  SensorLowPass<double> filter(cutoff_Hz, poles, kRate_Hz);
  double largest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double y = filter.push(std::sin(2.0 * std::numbers::pi * frequency_Hz * i / kRate_Hz));
    if (i > 10000) largest = std::max(largest, std::abs(y));
  }
  return largest;
}

TEST(SensorLowPass, HasItsCutOffAndSlope) {
  EXPECT_NEAR(gain(1000.0, 2, 1000.0), std::numbers::sqrt2 / 2.0, 5e-3);  // the sine's sampled peaks
  EXPECT_NEAR(gain(200.0, 1, 200.0), std::numbers::sqrt2 / 2.0, 1e-3);
  EXPECT_NEAR(gain(1000.0, 2, 20.0), 1.0, 1e-3);
  EXPECT_NEAR(gain(100.0, 2, 1000.0), 0.01, 5e-4);
  EXPECT_NEAR(gain(100.0, 1, 1000.0), 0.1, 2e-3);
}

TEST(SensorLowPass, StartsSettled) {
  for (const int poles : {1, 2}) {
    SensorLowPass<double> filter(1000.0, poles, 40000.0);
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(filter.push(9.8), 9.8, 1e-12);
  }
}

TEST(ProbeSampler, NoiseAtRestIsItsDensityTimesItsBandwidth) {
  const SimulationConfig config;
  const Calibration truth = make_probe_truth(config.probe, config.tracker, 1);
  ProbeSampler sampler(config, truth, 0);
  MotionState still;
  for (int i = 0; i < 200000; ++i) {
    still.t_s = i * config.step_s;
    sampler.push(still);
  }
  const Eigen::Matrix3d B = truth.accelerometer.B;
  const Eigen::Matrix3d inverse = B.inverse();
  const Eigen::Vector3d at_rest(0.0, -9.80665, 0.0);
  Eigen::Vector3d accel_square = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro_square = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < sampler.samples.size(); ++i) {
    accel_square += (inverse * (sampler.samples.accel_counts[i] - truth.accelerometer.C) - at_rest).cwiseAbs2();
    gyro_square += (truth.gyroscope->B.inverse() * (sampler.samples.gyro_counts[i] - truth.gyroscope->C)).cwiseAbs2();
  }
  const double n = static_cast<double>(sampler.samples.size());
  ASSERT_GT(n, 19900.0);
  // 70 µg/√Hz and 2.8 mdps/√Hz over the 1110 Hz of a second-order Butterworth at 1 kHz, and rounding to counts.
  const double accel_mps2 = std::hypot(70e-6 * 9.80665 * std::sqrt(1110.7), 9.80665 / 2048.0 / std::sqrt(12.0));
  const double gyro_radps =
      std::hypot(2.8e-3 * std::sqrt(1110.7), 1.0 / 16.4 / std::sqrt(12.0)) * std::numbers::pi / 180.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(accel_square[axis] / n) / accel_mps2, 1.0, 0.03);  // 6 σ of 20000, and 0.5 % of scale
    EXPECT_NEAR(std::sqrt(gyro_square[axis] / n) / gyro_radps, 1.0, 0.03);
  }
}

TEST(ProbeSampler, ClipsAtItsRange) {
  SimulationConfig config;
  const Calibration truth = make_probe_truth(config.probe, config.tracker, 1);
  ProbeSampler sampler(config, truth, 0);
  MotionState shaken;
  for (int i = 0; i < 4000; ++i) {
    shaken.t_s = i * config.step_s;
    // 5 mm at 50 Hz is 493 m/s² where the range ends at 157.
    shaken.p_world_tip_m.x() = 5e-3 * std::sin(2.0 * std::numbers::pi * 50.0 * shaken.t_s);
    sampler.push(shaken);
  }
  double low = 0.0;
  double high = 0.0;
  for (const Eigen::Vector3d& counts : sampler.samples.accel_counts) {
    low = std::min(low, counts.x());
    high = std::max(high, counts.x());
  }
  EXPECT_EQ(low, -32768.0);
  EXPECT_EQ(high, 32767.0);
}

}  // namespace
}  // namespace asperity
