#include "asperity/pipeline/measure_repeatability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;

// The same surface, scanned from `start_m` on, with white noise.
RepeatedScan scan(double start_m, double noise_m, std::uint64_t seed) {
  Random random(seed);
  RepeatedScan out;
  out.profile.spacing_m = kSpacing_m;
  for (std::size_t k = 0; k < 2400; ++k) {
    const double s_m = kSpacing_m * static_cast<double>(k);
    const double x_mm = 1e3 * (s_m + start_m);
    out.profile.s_m.push_back(s_m);
    out.profile.height_m.push_back(30e-6 * std::sin(2.0 * std::numbers::pi * x_mm / 2.5) +
                                   10e-6 * std::sin(2.0 * std::numbers::pi * x_mm / 1.13) + noise_m * random.normal());
  }
  out.periodicity.periodic = true;
  out.speed_mps = 0.025;
  out.probe_rate_Hz = 4000.0;
  return out;
}

TEST(MeasureRepeatability, FindsTheShiftsAndTheNoise) {
  constexpr double kNoise_m = 2e-6;
  std::vector<RepeatedScan> scans{scan(0.0, kNoise_m, 1), scan(0.4e-3, kNoise_m, 2), scan(-0.33e-3, kNoise_m, 3)};
  scans[0].periodicity.pitch_m = 2.4e-3;
  scans[1].periodicity.pitch_m = 2.5e-3;
  scans[2].periodicity.pitch_m = 2.6e-3;
  const Repeatability r = measure_repeatability(scans, {});
  EXPECT_NEAR(r.with_first[0].shift_m, 0.0, 1e-9);
  EXPECT_NEAR(r.with_first[0].correlation, 1.0, 1e-9);
  EXPECT_NEAR(r.with_first[1].shift_m, 0.4e-3, 3e-6);
  EXPECT_NEAR(r.with_first[2].shift_m, -0.33e-3, 3e-6);
  EXPECT_GT(r.correlation.mean, 0.99);
  EXPECT_EQ(r.correlation.count, 2U);
  EXPECT_NEAR(r.pitch_m.mean, 2.5e-3, 1e-12);
  EXPECT_NEAR(r.pitch_m.deviation, 0.1e-3, 1e-12);
  // Of the white noise up to 20 cycles/mm the band to 4 holds about a fifth of the variance.
  EXPECT_NEAR(r.spread_rms_m, kNoise_m * std::sqrt(0.2), 0.25 * kNoise_m * std::sqrt(0.2));
  ASSERT_EQ(r.height_m.size(), 3U);
  ASSERT_EQ(r.height_m[2].size(), r.s_m.size());
  ASSERT_EQ(r.deviation_m.size(), r.s_m.size());
}

TEST(MeasureRepeatability, TheBandIsThatOfTheFastestScan) {
  std::vector<RepeatedScan> scans{scan(0.0, 0.0, 1), scan(0.0, 0.0, 2)};
  EXPECT_EQ(measure_repeatability(scans, {}).band_high_cycles_per_mm, 4.0);
  scans[1].speed_mps = 0.8;  // 0.4 · 4000 Hz / 800 mm/s
  EXPECT_NEAR(measure_repeatability(scans, {}).band_high_cycles_per_mm, 2.0, 1e-12);
}

TEST(MeasureRepeatability, WhereOneHasAGapThereIsNoSpread) {
  std::vector<RepeatedScan> scans{scan(0.0, 0.0, 1), scan(0.0, 0.0, 2)};
  for (std::size_t k = 1000; k < 1100; ++k) scans[1].profile.height_m[k] = NAN;
  const Repeatability r = measure_repeatability(scans, {});
  const auto at = static_cast<std::size_t>(std::lround((1050 * kSpacing_m - r.s_m.front()) / kSpacing_m));
  EXPECT_TRUE(std::isfinite(r.height_m[0][at]));
  EXPECT_TRUE(std::isnan(r.height_m[1][at]));
  EXPECT_TRUE(std::isnan(r.deviation_m[at]));
  EXPECT_TRUE(std::isfinite(r.spread_rms_m));
}

TEST(MeasureRepeatability, OneScanIsNotRepeated) {
  const std::vector<RepeatedScan> one{scan(0.0, 0.0, 1)};
  EXPECT_THROW(measure_repeatability(one, {}), Error);
}

}  // namespace
}  // namespace asperity
