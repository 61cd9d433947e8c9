#include "asperity/pipeline/accelerometer_floor.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

// 4 s at 2 kHz of white noise of 5 counts and a vibration of 80 Hz.
Recording readings() {
  Random random(1, 0);
  Recording out;
  out.calibration.uncalibrated = false;
  out.calibration.accelerometer.residual_counts = Eigen::Vector3d(5.0, 5.0, 5.0);
  for (int i = 0; i < 8000; ++i) {
    const double vibration_counts = 300.0 * std::sin(2.0 * std::numbers::pi * 80.0 * i / 2000.0);
    out.probe.t_ns.push_back(500000LL * i);
    const Eigen::Vector3d counts = Eigen::Vector3d::Constant(vibration_counts) +
                                   5.0 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    out.probe.accel_counts.emplace_back(counts.array().round().matrix());
  }
  return out;
}

// A first-order low-pass over the readings.
Recording filtered(Recording r, double corner_Hz) {
  const double share = 1.0 - std::exp(-2.0 * std::numbers::pi * corner_Hz / 2000.0);
  Eigen::Vector3d state = r.probe.accel_counts.front();
  for (Eigen::Vector3d& counts : r.probe.accel_counts) counts = state += share * (counts - state);
  return r;
}

TEST(AccelerometerFloor, OfAWholeBandIsTheStatedNoise) {
  const AccelerometerFloor floor = accelerometer_floor(readings());
  EXPECT_NEAR(floor.rounding_ratio, 300.0, 30.0);  // 25 over 1/12
  EXPECT_NEAR(floor.ratio, 1.0, 0.1);  // a median over 100 frequencies of 14 segments, the largest of three channels
  EXPECT_TRUE(std::isnan(floor.from_Hz));
}

TEST(AccelerometerFloor, FallsWhereReadingsWereSmoothed) {
  const AccelerometerFloor once = accelerometer_floor(filtered(readings(), 50.0));
  // One pole at 50 Hz: a density of about (50/750)² in the highest octave.
  EXPECT_LT(once.ratio, 0.02);
  EXPECT_LE(once.from_Hz, 250.0);
  EXPECT_GE(once.from_Hz, 60.0);
  // These are no whole counts, so that nothing can be said of rounding.
  EXPECT_TRUE(std::isnan(once.rounding_ratio));
}

TEST(AccelerometerFloor, IsNotKnownWithoutStatedNoiseOrReadings) {
  Recording r = readings();
  r.calibration.accelerometer.residual_counts.setZero();
  EXPECT_TRUE(std::isnan(accelerometer_floor(r).ratio));
  r = readings();
  r.calibration.uncalibrated = true;
  EXPECT_TRUE(std::isnan(accelerometer_floor(r).ratio));
  r = readings();
  r.probe.t_ns.resize(1000);
  r.probe.accel_counts.resize(1000);
  EXPECT_TRUE(std::isnan(accelerometer_floor(r).ratio));
  EXPECT_TRUE(std::isnan(accelerometer_floor(Recording{}).ratio));
}

}  // namespace
}  // namespace asperity
