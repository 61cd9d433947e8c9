#include "asperity/pipeline/merge_results.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;

// Strokes over sums of waves of 0.25 to 2.5 cycles/mm, 30 µm RMS, with 3 µm of white noise that they state.
std::vector<MergeStroke> strokes(std::size_t points, bool states_noise = true) {
  constexpr int kWaves = 150;
  constexpr double kSpacing_mm = 0.025, kNoise_m = 3e-6;
  Random random(8, 1);
  std::vector<double> per_mm, phase;
  for (int i = 0; i < kWaves; ++i) {
    per_mm.push_back(2.0 * std::numbers::pi * (0.25 + 2.25 * (i + random.uniform()) / kWaves));
    phase.push_back(random.uniform(0.0, 2.0 * std::numbers::pi));
  }
  std::vector<MergeStroke> out;
  for (const char* name : {"a", "b", "c"}) {
    ProfilePass pass;
    pass.name = name;
    for (std::size_t i = 0; i < points; ++i) {
      double height_m = kNoise_m * random.normal();
      for (std::size_t k = 0; k < per_mm.size(); ++k) {
        height_m +=
            30e-6 * std::sqrt(2.0 / kWaves) * std::cos(per_mm[k] * kSpacing_mm * static_cast<double>(i) + phase[k]);
      }
      pass.texture_m.push_back(height_m);
    }
    pass.slow_m.assign(points, 0.0);
    pass.place_sigma_m = 1e-6;
    if (states_noise) {
      pass.frequency_cycles_per_mm = {0.0, 20.0};
      pass.noise_psd_m2_mm.assign(2, 2.0 * kNoise_m * kNoise_m * kSpacing_mm);
    }
    out.push_back({pass, {}, {}});
  }
  return out;
}

std::vector<std::string> codes(const std::vector<MergeStroke>& of) {
  std::vector<std::string> out;
  for (const Verdict& verdict : merge_results(of, "test", {}).verdicts) out.push_back(verdict.code);
  return out;
}

TEST(MergeResults, WhatIsNotKnownIsNotValid) {
  EXPECT_THAT(codes(strokes(2000)), IsEmpty());
  // A gap leaves two parts of 9 mm: fewer than the 12.8 mm by which differences are judged.
  std::vector<MergeStroke> brief = strokes(740);
  for (std::size_t i = 366; i < 374; ++i) brief[1].pass.texture_m[i] = std::nan("");
  const ProcessResult result = merge_results(brief, "test", {});
  EXPECT_TRUE(result.passes->agrees);
  EXPECT_TRUE(std::isnan(result.passes->noise_ratio));
  EXPECT_NE(verdict_word(result.verdicts), "valid");
  EXPECT_THAT(codes(brief), Contains("passes_uncompared"));
  const ProcessResult silent = merge_results(strokes(2000, false), "test", {});
  EXPECT_FALSE(silent.trustworthy);
  EXPECT_THAT(codes(strokes(2000, false)), Contains("error_unknown"));
}

TEST(MergeResults, AnInvalidStrokeIsNamed) {
  std::vector<MergeStroke> all = strokes(2000);
  all[1].invalid = "of another scale";
  const ProcessResult result = merge_results(all, "test", {});
  EXPECT_FALSE(result.trustworthy);
  EXPECT_THAT(result.verdict, testing::HasSubstr("b: of another scale"));
  EXPECT_THAT(codes(strokes(2000)), Not(Contains("stroke_invalid")));
}

}  // namespace
}  // namespace asperity
