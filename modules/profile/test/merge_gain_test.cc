#include "asperity/profile/merge_gain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {
namespace {

// The band is 0.15 to 4 cycles/mm.
TEST(MergeGain, IntegratesTheMergesDensityOverTheBand) {
  MergedProfile merged;
  merged.agrees = true;
  merged.passes.resize(3);
  merged.passes[0].used = merged.passes[1].used = true;
  merged.passes[0].stated_noise_rms_m = 3e-6;
  merged.passes[0].noise_rms_m = 4e-6;         // shown by the differences: this one counts
  merged.passes[1].stated_noise_rms_m = 2e-6;  // its differences are not known
  merged.passes[2].stated_noise_rms_m = 1.0;   // not used
  merged.noise.frequency_cycles_per_mm = {0.0, 2.0, 10.0};
  merged.noise.added_psd_m2_mm = {0.0, 2e-12, 2e-12};  // f to 2, then 2
  merged.noise.misplaced_psd_m2_mm = {1e-13, 1e-13, 1e-13};
  merged.noise.scale_sigma = 0.01;
  merged.noise.texture_rms_m = 50e-6;
  const MergeGain gain = merge_gain(merged, {});
  // By hand: (2² − 0.15²)/2 + 2·2 = 5.98875, 0.1·3.85 = 0.385, (0.01·50)² = 0.25.
  EXPECT_NEAR(gain.merged_noise_rms_m, 1e-6 * std::sqrt(5.98875 + 0.385 + 0.25), 1e-15);
  EXPECT_NEAR(gain.stroke_noise_rms_m, 1e-6 * std::sqrt((16.0 + 4.0) / 2.0), 1e-15);
  EXPECT_NEAR(gain.share, gain.merged_noise_rms_m / gain.stroke_noise_rms_m, 1e-15);
}

TEST(MergeGain, IsNotKnownWithoutAMergeOrItsNoise) {
  MergedProfile merged;
  EXPECT_TRUE(std::isnan(merge_gain(merged, {}).share));
  merged.agrees = true;
  merged.passes.resize(2);
  merged.passes[0].used = merged.passes[1].used = true;
  EXPECT_TRUE(std::isnan(merge_gain(merged, {}).share));
  merged.noise.frequency_cycles_per_mm = {0.0, 20.0};
  merged.noise.added_psd_m2_mm = {1e-12, 1e-12};
  EXPECT_TRUE(std::isnan(merge_gain(merged, {}).share));
}

// K strokes of one relief with white noise of one size and no other error have 1/√K of it.
TEST(MergeGain, IsOneOverTheRootOfTheStrokes) {
  constexpr double kNoise_m = 3e-6, kSpacing_m = 0.025e-3;
  constexpr std::size_t kPoints = 2400, kStrokes = 4;
  Random random(5, 1);
  std::vector<double> relief_m(kPoints, 0.0);
  for (int wave = 0; wave < 60; ++wave) {
    const double per_point = 0.04 + 0.3 * random.uniform(), phase = random.uniform(0.0, 6.283185);
    for (std::size_t i = 0; i < kPoints; ++i)
      relief_m[i] += 4e-6 * std::cos(per_point * static_cast<double>(i) + phase);
  }
  std::vector<ProfilePass> passes;
  for (std::size_t k = 0; k < kStrokes; ++k) {
    ProfilePass& pass = passes.emplace_back();
    pass.name = std::to_string(k);
    pass.spacing_m = kSpacing_m;
    for (const double h_m : relief_m) pass.texture_m.push_back(h_m + kNoise_m * random.normal());
    pass.frequency_cycles_per_mm = {0.0, 20.0};
    pass.noise_psd_m2_mm.assign(2, 2.0 * kNoise_m * kNoise_m * 1e3 * kSpacing_m);
    pass.noise_relative = 0.1;
    pass.place_sigma_m = 0.1e-6;
  }
  const MergedProfile merged = merge_passes(passes, {});
  ASSERT_TRUE(merged.agrees);
  const MergeGain gain = merge_gain(merged, {});
  // A stroke's noise by its differences scatters by √(2/ν) of its power, ν some 100 of 60 mm: 7 % of its RMS; the
  // larger one of it and what is stated counts in both.
  EXPECT_NEAR(gain.share, 1.0 / std::sqrt(static_cast<double>(kStrokes)), 0.05);
  // White noise from 0.15 to 4 of 20 cycles/mm.
  EXPECT_NEAR(gain.stroke_noise_rms_m, kNoise_m * std::sqrt(3.85 / 20.0), 0.15e-6);
  // Heights on the merge's points are the strokes' own.
  ASSERT_EQ(merged.passes[0].texture_m.size(), merged.profile.size());
  double apart2 = 0.0, count = 0.0;
  for (std::size_t i = 0; i < merged.profile.size(); ++i) {
    if (!std::isfinite(merged.passes[0].texture_m[i]) || !std::isfinite(merged.profile.texture_m[i])) continue;
    apart2 += std::pow(merged.passes[0].texture_m[i] - merged.profile.texture_m[i], 2);
    count += 1.0;
  }
  // y − mean of K: noise times √((K − 1)/K). Places between samples are interpolated, which lowers white noise.
  EXPECT_NEAR(std::sqrt(apart2 / count), kNoise_m * std::sqrt(3.0 / 4.0), 0.25 * kNoise_m);
}

}  // namespace
}  // namespace asperity
