#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "asperity/pipeline/force_limit.h"

namespace asperity {
namespace {

constexpr double kNewtonPerCount = 1e-3;
constexpr double kOffset_N = -0.2;  // without a force the sensor reads 200 counts

// 4 s at 1 kHz: a force that rises from 0 to 2.5 N and falls again, with `noise_counts` and rounded to `step` counts;
// cut off above `limit_N`.
Recording pressed(double limit_N, double noise_counts, double step = 1.0, int held = 1) {
  Random random(3, 0);
  Recording out;
  out.calibration.force = {kNewtonPerCount, kOffset_N, 1e-3, std::nullopt};
  double kept = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double force_N = 2.5 * std::sin(std::numbers::pi * i / 4000.0) + 1e-3 * noise_counts * random.normal();
    if (i % held == 0) {
      kept = step * std::round((std::min(force_N, limit_N) - kOffset_N) / kNewtonPerCount / step);
    }
    out.probe.t_ns.push_back(1000000LL * i);
    out.probe.force_counts.push_back(kept);
  }
  return out;
}

TEST(FindForceLimit, OfASensorThatIsCutOffIsTheShareAboveTheLimit) {
  for (const double noise_counts : {0.0, 5.0}) {
    const ForceLimit limit = find_force_limit(pressed(1.8, noise_counts));
    // 2.5 sin(πt/4) is above 1.8 for 4 s · (1 − 2 asin(0.72)/π) = 1.953 s of 4 s; with noise the edges are ragged.
    EXPECT_NEAR(limit.share(), 0.488, noise_counts > 0.0 ? 0.01 : 0.001);
    EXPECT_NEAR(limit.limit_N, 1.8, 1e-3);
    EXPECT_TRUE(limit.is_limited());
  }
}

TEST(FindForceLimit, TheConvertersOwnRangeCountsReadingByReading) {
  Recording r = pressed(10.0, 30.0);
  r.info.adc_min = 0.0;
  r.info.adc_max = 2600.0;  // 2.4 N, where noise crosses the limit again and again
  for (double& counts : r.probe.force_counts) counts = std::clamp(counts, r.info.adc_min, r.info.adc_max);
  const ForceLimit limit = find_force_limit(r);
  EXPECT_TRUE(limit.is_limited());
  EXPECT_NEAR(limit.limit_N, 2.4, 1e-9);
  // Above 2.4 N for 1 − 2 asin(0.96)/π = 18 % of the time.
  EXPECT_NEAR(limit.share(), 0.18, 0.01);
}

// The peak of a smooth force that is rounded stays at its highest count for longer than at others, and no limit is
// there.
TEST(FindForceLimit, ARoundedPeakIsNone) {
  for (const double step : {1.0, 4.0, 30.0, 100.0, 400.0}) {
    for (const double noise_counts : {0.0, 0.3, 1.0, 5.0, 50.0}) {
      EXPECT_FALSE(find_force_limit(pressed(10.0, noise_counts, step)).is_limited())
          << "rounded to " << step << " counts, noise of " << noise_counts;
    }
  }
}

TEST(FindForceLimit, ReadingsThatAreHeldAreNone) {
  EXPECT_FALSE(find_force_limit(pressed(10.0, 5.0, 1.0, 20)).is_limited());  // 50 Hz among rows at 1 kHz
  EXPECT_TRUE(find_force_limit(pressed(1.8, 5.0, 1.0, 20)).is_limited());
}

// Lifted off, a sensor may read the same all the time: that is no limit of what it can see.
TEST(FindForceLimit, AConstantReadingWithoutAForceIsNone) {
  Recording r = pressed(10.0, 5.0);
  const double no_load = -kOffset_N / kNewtonPerCount;
  for (std::size_t i = 0; i < 1000; ++i) r.probe.force_counts[i] = no_load;
  EXPECT_FALSE(find_force_limit(r).is_limited());
}

// The range in a recording is that of the inertial sensors; a force converter of 24 bit reads far beyond it.
TEST(FindForceLimit, TheRangeOfAnotherConverterCountsForNothing) {
  Recording r = pressed(10.0, 5.0);
  for (double& counts : r.probe.force_counts) counts *= 800.0;
  r.calibration.force.newton_per_count = kNewtonPerCount / 800.0;
  r.info.adc_min = -32768.0;
  r.info.adc_max = 32767.0;
  EXPECT_FALSE(find_force_limit(r).is_limited());
}

// A sensor that cannot read below no load is at the end of its converter's range while it is lifted off.
TEST(FindForceLimit, TheEndWithoutALoadIsNone) {
  Recording r = pressed(10.0, 5.0);
  const double no_load = -kOffset_N / kNewtonPerCount;
  r.info.adc_min = no_load;
  r.info.adc_max = 65535.0;
  for (double& counts : r.probe.force_counts) counts = std::max(counts, no_load);
  for (std::size_t i = 0; i < 1000; ++i) r.probe.force_counts[i] = no_load;
  EXPECT_FALSE(find_force_limit(r).is_limited());
}

TEST(FindForceLimit, ASpikeHidesNoLimit) {
  for (const double spike : {-10000.0, 4000.0}) {
    Recording r = pressed(1.8, 5.0);
    r.probe.force_counts[50] = spike;
    const ForceLimit limit = find_force_limit(r);
    EXPECT_TRUE(limit.is_limited()) << spike;
    EXPECT_NEAR(limit.limit_N, 1.8, 1e-3) << spike;
  }
}

TEST(FindForceLimit, ASensorThatIsPressedTowardsFewerCountsHasItsLimitThere) {
  Recording r = pressed(1.8, 5.0);
  r.calibration.force.newton_per_count = -kNewtonPerCount;
  r.calibration.force.offset_newton = -0.2;
  for (double& counts : r.probe.force_counts) counts = -counts;
  const ForceLimit limit = find_force_limit(r);
  EXPECT_TRUE(limit.is_limited());
  EXPECT_NEAR(limit.limit_N, 1.8, 1e-3);
}

TEST(FindForceLimit, OfThreeAxesEachIsExamined) {
  Recording r = pressed(1.8, 5.0);
  Force3Calibration three;
  three.B = Eigen::Matrix3d::Identity() / kNewtonPerCount;
  three.C = Eigen::Vector3d::Constant(200.0);
  r.calibration.force3 = three;
  for (std::size_t i = 0; i < r.probe.size(); ++i) {
    const double lateral = 200.0 + std::sin(0.01 * static_cast<double>(i)) * 300.0;
    r.probe.force3_counts.emplace_back(lateral, r.probe.force_counts[i], lateral);
  }
  r.probe.force_counts.assign(r.probe.size(), std::numeric_limits<double>::quiet_NaN());
  const ForceLimit limit = find_force_limit(r);
  EXPECT_TRUE(limit.is_limited());
  EXPECT_NEAR(limit.limit_N, 1.8, 1e-3);
}

TEST(FindForceLimit, WithoutAForceThereIsNone) {
  EXPECT_FALSE(find_force_limit(Recording{}).is_limited());
  Recording constant = pressed(10.0, 0.0);
  constant.probe.force_counts.assign(constant.probe.size(), 700.0);
  EXPECT_FALSE(find_force_limit(constant).is_limited());
}

}  // namespace
}  // namespace asperity
