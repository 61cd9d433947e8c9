#include "asperity/profile/lay_merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kStep_m = 0.025e-3;
constexpr double kNoise_m = 4e-6;
constexpr std::size_t kStroke = 1600, kTurn = 200;

// Waves of 0.3 to 2 cycles/mm, 30 µm RMS.
double relief_m(double x_m) {
  double sum = 0.0;
  for (int i = 0; i < 60; ++i)
    sum += std::cos(2.0 * std::numbers::pi * 1e3 * (0.3 + 1.7 * i / 60.0) * x_m + 2.4 * i * i);
  return 30e-6 * std::sqrt(2.0 / 60.0) * sum;
}

// A profile that goes over 40 mm of relief there and back, with a turn between, all with white noise.
struct There {
  Profile profile;
  TextureNoise noise;
  std::vector<double> truth_m;
  std::vector<ProfilePass> passes;
  std::vector<PassInProfile> parts{{0, 0}, {1, kStroke + kTurn}};
};

There there_and_back(std::uint64_t seed) {
  There out;
  Random random(seed, 1);
  out.profile.spacing_m = kStep_m;
  for (std::size_t i = 0; i < 2 * kStroke + kTurn; ++i) {
    const bool back = i >= kStroke + kTurn;
    const double x_m = kStep_m * static_cast<double>(back ? 2 * kStroke + kTurn - 1 - i : i);
    out.truth_m.push_back(i >= kStroke && !back ? 0.0 : relief_m(x_m));
    out.profile.s_m.push_back(kStep_m * static_cast<double>(i));
    out.profile.texture_m.push_back(out.truth_m.back() + kNoise_m * random.normal());
    out.profile.height_m.push_back(out.profile.texture_m.back() + 1e-3);
  }
  const std::size_t points = out.profile.size();
  out.profile.sigma_m.assign(points, kNoise_m);
  out.profile.texture_sigma_m.assign(points, kNoise_m);
  TextureNoise& noise = out.noise;
  noise.frequency_cycles_per_mm = {0.0, 20.0};
  noise.added_psd_m2_mm.assign(2, 2.0 * kNoise_m * kNoise_m * 1e3 * kStep_m);
  noise.added_sigma_m.assign(points, kNoise_m);
  noise.misplaced_sigma_m.assign(points, 0.0);
  noise.noise_rms_m = noise.added_rms_m = noise.typical_added_rms_m = kNoise_m;
  noise.noise_rms_stderr_m = noise.added_rms_stderr_m = 0.1 * kNoise_m;
  noise.typical_misplaced_rms_m = 0.0;
  noise.texture_rms_m = noise.typical_texture_rms_m = std::hypot(30e-6, kNoise_m);
  for (const PassInProfile& part : out.parts) {
    ProfilePass& pass = out.passes.emplace_back();
    pass.name = "pass";
    const auto begin = out.profile.texture_m.begin() + static_cast<std::ptrdiff_t>(part.first);
    pass.texture_m.assign(begin, begin + static_cast<std::ptrdiff_t>(kStroke));
    pass.slow_m.assign(kStroke, 1e-3);
    pass.frequency_cycles_per_mm = noise.frequency_cycles_per_mm;
    pass.noise_psd_m2_mm = noise.added_psd_m2_mm;
    pass.place_sigma_m = 1e-6;
  }
  return out;
}

double error_rms_m(const There& there, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += std::pow(there.profile.texture_m[i] - there.truth_m[i], 2);
  return std::sqrt(sum / static_cast<double>(end - begin));
}

TEST(LayMerge, BothStrokesGetTheMeanAndItsNoiseAndTheTurnStays) {
  There there = there_and_back(5);
  const MergedProfile merged = merge_passes(there.passes, {});
  ASSERT_TRUE(merged.agrees);
  // White noise in both: the differences have its power. Six segments of 51 lines in the band: ± 6 %.
  EXPECT_NEAR(merged.noise_scale, 1.0, 0.25);
  EXPECT_LT(merged.lines_over_noise, 0.3);
  const Profile before = there.profile;
  lay_merge(merged, there.parts, there.profile, there.noise);
  const double expected_m = kNoise_m / std::sqrt(2.0);
  // 1500 independent heights: ± 1.8 %; interpolation between points smooths some of the white noise too.
  EXPECT_NEAR(error_rms_m(there, 60, kStroke - 60), expected_m, 0.15 * expected_m);
  EXPECT_NEAR(error_rms_m(there, kStroke + kTurn + 60, 2 * kStroke + kTurn - 60), expected_m, 0.15 * expected_m);
  for (std::size_t i = kStroke; i < kStroke + kTurn; ++i) ASSERT_EQ(there.profile.texture_m[i], before.texture_m[i]);
  for (std::size_t i = 0; i < there.profile.size(); ++i)
    ASSERT_NEAR(there.profile.height_m[i] - there.profile.texture_m[i], 1e-3, 1e-12);
  EXPECT_NEAR(there.noise.added_sigma_m[800], expected_m, 0.1 * expected_m);
  EXPECT_EQ(there.noise.added_sigma_m[kStroke + 10], kNoise_m);
  EXPECT_NEAR(there.profile.texture_sigma_m[800], there.noise.added_sigma_m[800], 1e-12);
  // 94 % of the points are laid less the blends: half of the power there.
  const double share = (2.0 * kStroke - 2.0 * 80.0) / (2.0 * kStroke + kTurn);
  EXPECT_NEAR(there.noise.added_rms_m / kNoise_m, std::sqrt(1.0 - 0.5 * share), 0.05);
  EXPECT_GT(there.noise.snr, 1.5 * 56.0);  // (30/4)² before
}

TEST(LayMerge, GapsStayAndPassesBeyondTheProfileAreRefused) {
  There there = there_and_back(6);
  const MergedProfile merged = merge_passes(there.passes, {});
  for (std::size_t i = 700; i < 720; ++i) there.profile.texture_m[i] = there.profile.height_m[i] = std::nan("");
  lay_merge(merged, there.parts, there.profile, there.noise);
  EXPECT_TRUE(std::isnan(there.profile.texture_m[710]));
  EXPECT_TRUE(std::isfinite(there.profile.texture_m[725]));
  there.parts[1].first = 2 * kStroke;
  EXPECT_THROW(lay_merge(merged, there.parts, there.profile, there.noise), Error);
}

TEST(AlignPasses, KeepsToWhereThePathsAre) {
  // A relief that repeats after 5 mm fits at every period: the place decides at which.
  const auto repeated_m = [](double x_m) { return relief_m(x_m - 5e-3 * std::floor(x_m / 5e-3)); };
  std::vector<ProfilePass> passes;
  for (std::uint64_t k = 0; k < 2; ++k) {
    Random random(9 + k, 3);
    ProfilePass& pass = passes.emplace_back();
    pass.name = "pass";
    pass.spacing_m = kStep_m;
    for (std::size_t i = 0; i < 2000; ++i)
      pass.texture_m.push_back(repeated_m(kStep_m * static_cast<double>(k == 0 ? i : 2120 - i)) +
                               1e-6 * random.normal());
    pass.frequency_cycles_per_mm = {0.0, 20.0};
    pass.noise_psd_m2_mm.assign(2, 2.0 * 1e-12 * 1e3 * kStep_m);
    pass.place_sigma_m = 1e-6;
  }
  const double begin_m = kStep_m * 2120, shift_m = -121 * kStep_m;
  passes[0].place = PassPlace{0.0, false, 1e-3};
  passes[1].place = PassPlace{begin_m + 0.4e-3, true, 1e-3};  // 0.4 mm wrong
  // Reversed, the pass begins at x = 121 points: the reference's first point is 121 points before it, and the other way
  // round.
  for (const std::size_t reference : {0U, 1U}) {
    const PassAlignment at = align_passes(passes[reference], passes[1 - reference], {});
    EXPECT_TRUE(at.agrees);
    EXPECT_TRUE(at.reversed);
    EXPECT_NEAR(at.shift_m, shift_m, 0.1e-3);
  }
  // Two periods away it is found there.
  passes[1].place->start_m += 10e-3;
  EXPECT_NEAR(align_passes(passes[0], passes[1], {}).shift_m, shift_m - 10e-3, 0.1e-3);
}

}  // namespace
}  // namespace asperity
