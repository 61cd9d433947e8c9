#include "asperity/trajectory/calibrate_inertial.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace asperity {
namespace {

constexpr double kScale_counts = 100.0;  // per m/s²
constexpr double kRate_Hz = 1000.0;

// A second of rest with peaks of 8 ms along z, half sines of `peak_counts` on gravity.
Recording with_peaks(double peak_counts, int peaks) {
  Recording out;
  out.info.adc_min = -2048.0;
  out.info.adc_max = 2047.0;
  out.calibration.accelerometer.B = kScale_counts * Eigen::Matrix3d::Identity();
  for (int i = 0; i < 1000; ++i) {
    Eigen::Vector3d counts(i % 2, (i / 2) % 2, 981.0);
    const int into = i % (1000 / peaks) - 40;
    if (into >= 0 && into < 8) counts.z() += peak_counts * std::sin(std::numbers::pi * (into + 0.5) / 8.0);
    counts.z() = std::min(counts.z(), out.info.adc_max);
    out.probe.t_ns.push_back(1000000LL * i);
    out.probe.accel_counts.push_back(counts);
    out.probe.force_counts.push_back(0.0);
  }
  return out;
}

TEST(CalibrateInertial, WhatIsNotClippedAddsNoNoise) {
  const InertialStream stream = calibrate_inertial(with_peaks(1000.0, 10), {});
  EXPECT_EQ(stream.saturated, 0U);
  EXPECT_EQ(stream.clipped_m2ps3, Eigen::Vector3d::Zero());
}

// The error of the velocity that a restored peak leaves is known here, since the peak is. The density that is stated is
// that of errors as large as a share of the peak, so it is of the size of the true one and on that axis alone.
TEST(CalibrateInertial, ClippedPeaksAddTheNoiseOfTheVelocityThatTheyHide) {
  constexpr double kPeak_counts = 3000.0;
  constexpr int kPeaks = 10;
  const InertialStream stream = calibrate_inertial(with_peaks(kPeak_counts, kPeaks), {});
  ASSERT_GT(stream.saturated, 3U * kPeaks);
  double hidden_mps = 0.0;  // of a peak, beyond the range
  for (int into = 0; into < 8; ++into) {
    const double counts = 981.0 + kPeak_counts * std::sin(std::numbers::pi * (into + 0.5) / 8.0);
    hidden_mps += std::max(0.0, counts - 2047.0) / kScale_counts / kRate_Hz;
  }
  const double of_all_m2ps3 = 2.0 * kPeaks * hidden_mps * hidden_mps / 1.0;  // if nothing were restored
  EXPECT_LT(stream.clipped_m2ps3.z(), of_all_m2ps3);
  EXPECT_GT(stream.clipped_m2ps3.z(), 0.01 * of_all_m2ps3);
  EXPECT_EQ(stream.clipped_m2ps3.x(), 0.0);
  EXPECT_EQ(stream.clipped_m2ps3.y(), 0.0);
  EXPECT_NEAR(calibrate_inertial(with_peaks(kPeak_counts, 2 * kPeaks), {}).clipped_m2ps3.z(),
              2.0 * stream.clipped_m2ps3.z(), 0.01 * stream.clipped_m2ps3.z());
}

}  // namespace
}  // namespace asperity
