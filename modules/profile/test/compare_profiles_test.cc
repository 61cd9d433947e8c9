#include "asperity/profile/compare_profiles.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

// Many waves between 0.3 and 3 cycles/mm, RMS 20 µm.
double rough(double s_m) {
  Random random(11);
  double h = 0.0;
  constexpr int kWaves = 40;
  for (int i = 0; i < kWaves; ++i) {
    const double k = random.uniform(0.3, 3.0), phase = random.uniform(0.0, 6.28);
    h += std::sin(2.0 * std::numbers::pi * k * 1e3 * s_m + phase);
  }
  return 20e-6 * std::sqrt(2.0 / kWaves) * h;
}

struct Sampled {
  std::vector<double> s_m, h_m;
};

Sampled sample(double from_m, double to_m, double step_m, double shift_m, double gain, double noise_m) {
  Sampled out;
  Random random(12);
  const auto n = static_cast<int>((to_m - from_m) / step_m);
  for (int i = 0; i <= n; ++i) {
    out.s_m.push_back(from_m + i * step_m);
    out.h_m.push_back(gain * rough(out.s_m.back() + shift_m) + noise_m * random.normal());
  }
  return out;
}

TEST(CompareProfiles, FindsShiftGainAndNoise) {
  const Sampled truth = sample(0.0, 0.06, 7e-6, 0.0, 1.0, 0.0);
  for (const double shift_m : {0.0, 0.4e-3, -1.737e-3, 0.0123e-3}) {
    const Sampled measured = sample(0.0, 0.06, 25e-6, shift_m, 0.93, 0.0);
    const ProfileComparison c = compare_profiles(measured.s_m, measured.h_m, truth.s_m, truth.h_m, {});
    EXPECT_NEAR(c.shift_m, shift_m, 1e-6);
    EXPECT_NEAR(c.gain, 0.93, 2e-3);
    EXPECT_GT(c.correlation, 0.999);
    EXPECT_NEAR(c.rms_um, 0.07 * c.true_rms_um, 0.1 * 0.07 * c.true_rms_um + 0.1);
    EXPECT_NEAR(c.length_error_percent, 0.0, 0.06);
  }
}

TEST(CompareProfiles, NoiseLowersTheCorrelationByItsShareInTheBand) {
  const Sampled truth = sample(0.0, 0.4, 25e-6, 0.0, 1.0, 0.0);
  const Sampled measured = sample(0.0, 0.4, 25e-6, 0.0, 1.0, 40e-6);
  const ProfileComparison c = compare_profiles(measured.s_m, measured.h_m, truth.s_m, truth.h_m, {});
  // White noise up to 20 cycles/mm; the filter's noise bandwidth of its second-order low-pass at 4, squared
  // gain integrated: about 0.96·4 less 0.15.
  const double noise_um = 40.0 * std::sqrt(3.7 / 20.0);
  EXPECT_NEAR(c.rms_um, noise_um, 0.1 * noise_um);
  EXPECT_NEAR(c.correlation, c.true_rms_um / std::hypot(c.true_rms_um, noise_um), 0.03);
}

TEST(CompareProfiles, SlowDriftIsOutOfBandAndGapsDoNotCount) {
  const Sampled truth = sample(0.0, 0.06, 25e-6, 0.0, 1.0, 0.0);
  Sampled measured = truth;
  for (std::size_t i = 0; i < measured.s_m.size(); ++i) {
    measured.h_m[i] += 0.2e-3 * std::sin(2.0 * std::numbers::pi * measured.s_m[i] / 0.05);  // 0.02 cycles/mm
    if (i > 900 && i < 960) measured.h_m[i] = NAN;
  }
  const ProfileComparison c = compare_profiles(measured.s_m, measured.h_m, truth.s_m, truth.h_m, {});
  EXPECT_GT(c.correlation, 0.995);
  EXPECT_NEAR(c.compared_m, 0.06 - 2 * 3e-3 - 6e-3 - 1.5e-3, 0.2e-3);
}

TEST(CompareProfiles, ALiftOfTheTruthInAMeasuredGapDoesNotCount) {
  Sampled truth = sample(0.0, 0.06, 25e-6, 0.0, 1.0, 0.0);
  Sampled measured = truth;
  for (std::size_t i = 1000; i < 1100; ++i) {
    truth.h_m[i] += 3e-3;
    measured.h_m[i] = NAN;
  }
  const ProfileComparison c = compare_profiles(measured.s_m, measured.h_m, truth.s_m, truth.h_m, {});
  EXPECT_GT(c.correlation, 0.999);
}

TEST(CompareProfiles, TruthMayDwellAndRepeat) {
  Sampled truth = sample(0.0, 0.05, 6e-6, 0.0, 1.0, 0.0);
  const Sampled measured = sample(0.0, 0.05, 25e-6, 0.0, 1.0, 0.0);
  for (int i = 0; i < 3000; ++i) {
    truth.s_m.insert(truth.s_m.begin(), 0.0);
    truth.h_m.insert(truth.h_m.begin(), rough(0.0));
  }
  const ProfileComparison c = compare_profiles(measured.s_m, measured.h_m, truth.s_m, truth.h_m, {});
  EXPECT_GT(c.correlation, 0.9999);
  EXPECT_NEAR(c.gain, 1.0, 1e-3);
}

TEST(CompareProfiles, AStretchedPathShowsInTheLength) {
  const Sampled truth = sample(0.0, 0.05, 25e-6, 0.0, 1.0, 0.0);
  Sampled measured = truth;
  for (double& s : measured.s_m) s *= 1.012;
  EXPECT_NEAR(compare_profiles(measured.s_m, measured.h_m, truth.s_m, truth.h_m, {}).length_error_percent, 1.2, 0.02);
}

TEST(CompareProfiles, BandFollowsRateAndSpeed) {
  EXPECT_DOUBLE_EQ(comparison_limit_cycles_per_mm(4000.0, 0.025), 4.0);
  EXPECT_NEAR(comparison_limit_cycles_per_mm(400.0, 0.045), 0.4 * 400.0 / 45.0, 1e-12);
  EXPECT_THROW(comparison_limit_cycles_per_mm(400.0, 0.0), Error);
  const Sampled truth = sample(0.0, 0.05, 25e-6, 0.0, 1.0, 0.0);
  ComparisonConfig config;
  config.high_cycles_per_mm = 0.1;
  EXPECT_THROW(compare_profiles(truth.s_m, truth.h_m, truth.s_m, truth.h_m, config), Error);
  EXPECT_THROW(compare_profiles(truth.s_m, std::vector<double>(3), truth.s_m, truth.h_m, {}), Error);
}

}  // namespace
}  // namespace asperity
