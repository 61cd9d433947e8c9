#include "asperity/profile/merge_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

#include "../src/pass_signal.h"
#include "../src/warp_pass.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;

// Waves of 0.25 to 2.5 cycles/mm, known between the points.
class Line {
 public:
  explicit Line(std::uint64_t seed, double rms_m = 30e-6, double highest_per_mm = 2.5)
      : amplitude_m_(rms_m * std::sqrt(2.0 / kWaves)) {
    Random random(seed, 1);
    for (int i = 0; i < kWaves; ++i) {
      per_m_.push_back(2.0 * std::numbers::pi * 1e3 *
                       (0.25 + (highest_per_mm - 0.25) * (i + random.uniform()) / kWaves));
      phase_.push_back(random.uniform(0.0, 2.0 * std::numbers::pi));
    }
  }
  double operator()(double s_m) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < per_m_.size(); ++i) sum += std::cos(per_m_[i] * s_m + phase_[i]);
    return amplitude_m_ * sum;
  }
  // Mean square of the slope.
  double slope2() const {
    double sum = 0.0;
    for (const double k : per_m_) sum += 0.5 * std::pow(amplitude_m_ * k, 2);
    return sum;
  }

 private:
  static constexpr int kWaves = 200;
  double amplitude_m_;
  std::vector<double> per_m_, phase_;
};

struct Stroke {
  double shift_m = 0.0, stretch = 0.0, noise_m = 3e-6, sway_m = 0.0;
  bool reversed = false;
  std::uint64_t seed = 1;
};

double place_m(const Stroke& stroke, double x_m) {
  return (x_m - stroke.shift_m) / (1.0 + stroke.stretch) +
         stroke.sway_m * std::sin(2.0 * std::numbers::pi * x_m / 20e-3);
}

// Heights with white noise, whose density is 2 σ² d.
ProfilePass stroke_over(const Line& line, const Stroke& stroke, std::size_t points = 2400) {
  Random random(stroke.seed, 2);
  ProfilePass pass;
  pass.name = "stroke " + std::to_string(stroke.seed);
  pass.spacing_m = kSpacing_m;
  for (std::size_t i = 0; i < points; ++i) {
    pass.texture_m.push_back(line(place_m(stroke, kSpacing_m * static_cast<double>(i))) +
                             stroke.noise_m * random.normal());
  }
  if (stroke.reversed) std::reverse(pass.texture_m.begin(), pass.texture_m.end());
  pass.frequency_cycles_per_mm = {0.0, 20.0};
  pass.noise_psd_m2_mm.assign(2, 2.0 * stroke.noise_m * stroke.noise_m * 1e3 * kSpacing_m);
  pass.noise_relative = 0.1;
  pass.place_sigma_m = 0.5e-6;
  return pass;
}

// RMS of a merge from the line, up to a shift and a stretch of all, which no merge can know.
double error_rms_m(const MergedProfile& merge, const Line& line) {
  const std::vector<double>& h_m = merge.profile.texture_m;
  double shift_m = merge.passes[0].shift_m, stretch = merge.passes[0].stretch, rms_m = 0.0;
  for (int step = 0; step < 8; ++step) {
    double a = 0.0, b = 0.0, c = 0.0, g = 0.0, e = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 40; i + 40 < h_m.size(); ++i) {
      const double u = kSpacing_m * static_cast<double>(i), at = shift_m + u * (1.0 + stretch);
      const double slope = (line(at + 1e-6) - line(at - 1e-6)) / 2e-6, r = h_m[i] - line(at);
      a += slope * slope;
      b += slope * slope * u;
      c += slope * slope * u * u;
      g += slope * r;
      e += slope * r * u;
      sum += r * r;
      count += 1.0;
    }
    rms_m = std::sqrt(sum / count);
    const double det = a * c - b * b;
    shift_m += (c * g - b * e) / det;
    stretch += (a * e - b * g) / det;
  }
  return rms_m;
}

TEST(AlignPasses, FindsShiftStretchAndDirection) {
  const Line line(1);
  const ProfilePass reference = stroke_over(line, {.seed = 1});
  for (const bool turned : {false, true}) {
    const Stroke stroke{.shift_m = 2.3e-3, .stretch = 0.004, .reversed = turned, .seed = 2};
    const PassAlignment at = align_passes(reference, stroke_over(line, stroke), {});
    EXPECT_TRUE(at.agrees);
    EXPECT_EQ(at.reversed, turned);
    EXPECT_NEAR(at.stretch, 0.004, 0.002);  // half of the search's step of 0.0021
    // In the middle, where the stretch does not matter: the pass' point whose place is the reference's.
    const double middle_m = 0.5 * kSpacing_m * 2400, found_m = at.shift_m + middle_m * (1.0 + at.stretch);
    EXPECT_NEAR(place_m(stroke, found_m), middle_m, 0.1e-3);
  }
}

TEST(AlignPasses, RefusesOtherLinesAndNoise) {
  AlignPassesConfig config;
  config.false_alarm = 0.01;
  int alarms = 0;
  double most = 0.0;
  constexpr int kPairs = 40;
  for (int i = 0; i < kPairs; ++i) {
    const auto seed = static_cast<std::uint64_t>(10 + 2 * i);
    const double rms_m = i % 2 == 0 ? 30e-6 : 0.0;  // lines, or noise alone
    const PassAlignment at = align_passes(stroke_over(Line(seed, rms_m), {.seed = seed}, 1600),
                                          stroke_over(Line(seed + 1, rms_m), {.seed = seed + 1}, 1600), config);
    alarms += at.agrees ? 1 : 0;
    most = std::max(most, at.score / at.threshold);
  }
  EXPECT_LE(alarms, 2);  // 0.4 are expected at most
  EXPECT_GT(most, 0.3);  // the test is not asleep
}

TEST(MergePasses, PlacesReachTheCramerRaoBound) {
  // Of a shift in white noise: σ²/(n mean slope²), of two noisy passes twice that.
  constexpr int kTrials = 12;
  constexpr double kNoise_m = 6e-6;
  double square = 0.0, bound = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const auto seed = static_cast<std::uint64_t>(100 + i);
    const Line line(seed);
    const Stroke a{.noise_m = kNoise_m, .seed = seed},
        b{.shift_m = 1.111e-3, .stretch = -0.002, .noise_m = kNoise_m, .seed = seed + 1000};
    std::vector<ProfilePass> passes{stroke_over(line, a), stroke_over(line, b)};
    for (ProfilePass& pass : passes) pass.place_sigma_m = 1e-8;  // no sway is looked for
    const MergedProfile merge = merge_passes(passes, {});
    ASSERT_TRUE(merge.agrees);
    const double middle_m = 0.5 * kSpacing_m * static_cast<double>(merge.profile.size());
    const auto on_line_m = [&](const Stroke& stroke, const MergedPass& pass) {
      return place_m(stroke, pass.shift_m + middle_m * (1.0 + pass.stretch));
    };
    square += std::pow(on_line_m(a, merge.passes[0]) - on_line_m(b, merge.passes[1]), 2) / kTrials;
    // All of the noise below 4 cycles/mm counts, and all of the waves are below.
    bound += 2.0 * kNoise_m * kNoise_m / (static_cast<double>(merge.profile.size()) * line.slope2()) / kTrials;
  }
  // χ² with 12 degrees of freedom: 0.6 to 1.5 in the root with 99 %; knots and interpolation cost a little.
  EXPECT_LT(std::sqrt(square / bound), 1.8);
  EXPECT_GT(std::sqrt(square / bound), 0.6);
}

TEST(MergePasses, FivePassesHaveTheNoiseOfTheirMean) {
  const Line line(3);
  std::vector<ProfilePass> passes;
  for (std::uint64_t k = 0; k < 5; ++k) {
    passes.push_back(stroke_over(line, {.shift_m = 0.31e-3 * static_cast<double>(k),
                                        .stretch = 0.001 * static_cast<double>(k) - 0.002,
                                        .reversed = k % 2 == 1,
                                        .seed = 30 + k}));
  }
  const MergedProfile merge = merge_passes(passes, {});
  ASSERT_TRUE(merge.agrees);
  EXPECT_EQ(merge.used, 5U);
  EXPECT_TRUE(merge.passes[0].alignment.reversed != merge.passes[1].alignment.reversed);
  // Between points the interpolation has 0.64 of the power of white noise, at points all of it.
  EXPECT_NEAR(error_rms_m(merge, line), 0.9 * 3e-6 / std::sqrt(5.0), 0.2e-6);
  EXPECT_NEAR(merge.noise.added_rms_m, 3e-6 / std::sqrt(5.0), 0.2e-6);
  EXPECT_LT(merge.noise_ratio_low, 1.0);
  EXPECT_GT(merge.noise_ratio_high, 1.0);
  // The closest of ten pairs, of which each has a standard error of some 10 %.
  EXPECT_GT(merge.closest.ratio, 0.6);
  EXPECT_GT(merge.closest.ratio_high, 1.0);
  for (const MergedPass& pass : merge.passes) {
    EXPECT_NEAR(pass.weight, 0.2, 0.03);
    // In the band's 4 of 20 cycles/mm the noise is 3/√5 µm; the coherence with a mean of four is that of the powers.
    const double noise = 9e-12 * 4.0 / 20.0 / 900e-12;
    EXPECT_NEAR(pass.coherence, 1.0 / ((1.0 + noise) * (1.0 + noise / 4.0)), 0.002);
    EXPECT_NEAR(pass.noise_rms_m, 3e-6 / std::sqrt(5.0), 0.3e-6);
  }
}

TEST(MergePasses, SeesThatTwoPassesAreOneMeasurement) {
  const Line line(3);
  std::vector<ProfilePass> passes;
  for (std::uint64_t k = 0; k < 3; ++k) passes.push_back(stroke_over(line, {.seed = 30 + k}));
  // A part of one of them, which begins elsewhere.
  ProfilePass part = passes[1];
  part.texture_m.erase(part.texture_m.begin(), part.texture_m.begin() + 150);
  if (!part.slow_m.empty()) part.slow_m.erase(part.slow_m.begin(), part.slow_m.begin() + 150);
  passes.push_back(part);
  const MergedProfile merge = merge_passes(passes, {});
  ASSERT_TRUE(merge.agrees);
  EXPECT_EQ(merge.closest.first, 1U);
  EXPECT_EQ(merge.closest.second, 3U);
  EXPECT_LT(merge.closest.ratio_high, 0.05);
}

TEST(MergePasses, SeesThatThePassesDifferByMoreThanTheyState) {
  const Line line(4);
  std::vector<ProfilePass> passes;
  for (std::uint64_t k = 0; k < 4; ++k) {
    passes.push_back(stroke_over(line, {.noise_m = 6e-6, .seed = 40 + k}));
    for (double& density : passes.back().noise_psd_m2_mm) density /= 4.0;
  }
  const MergedProfile merge = merge_passes(passes, {});
  ASSERT_TRUE(merge.agrees);
  EXPECT_GT(merge.noise_ratio_low, 1.0);
  EXPECT_NEAR(merge.noise_ratio, 4.0, 0.6);  // four standard errors
  EXPECT_NEAR(merge.noise.added_rms_m, 3e-6, 0.4e-6);
}

TEST(MergePasses, FollowsPlacesThatSway) {
  const Line line(5);
  std::vector<ProfilePass> passes;
  for (std::uint64_t k = 0; k < 5; ++k) {
    passes.push_back(
        stroke_over(line, {.noise_m = 2e-6, .sway_m = 0.04e-3 * (static_cast<double>(k) - 2.0), .seed = 50 + k}));
    passes.back().place_sigma_m = 0.05e-3;
  }
  const MergedProfile merge = merge_passes(passes, {});
  ASSERT_EQ(merge.used, 5U);
  // The sways' mean is 0: the merge is on the line again. Without it 0.057 mm of RMS sway would leave 14 µm.
  EXPECT_LT(error_rms_m(merge, line), 2e-6);
}

TEST(MergePasses, TakesTheOthersWhereOneHasAGap) {
  const Line line(6);
  std::vector<ProfilePass> passes;
  for (std::uint64_t k = 0; k < 3; ++k) {
    passes.push_back(stroke_over(line, {.seed = 60 + k}));
    for (std::size_t i = 400 + 500 * k; i < 440 + 500 * k; ++i) passes.back().texture_m[i] = std::nan("");
  }
  const MergedProfile merge = merge_passes(passes, {});
  ASSERT_EQ(merge.used, 3U);
  EXPECT_NEAR(error_rms_m(merge, line), 0.9 * 3e-6 / std::sqrt(3.0), 0.25e-6);
  EXPECT_GT(merge.noise.added_sigma_m[420], 1.1 * merge.noise.added_sigma_m[700]);
}

// In either order: a noise that one stroke does not state is no noise of 0, which would have all of the weight.
TEST(MergePasses, AStrokeThatStatesNoNoiseCountsAsTheOthers) {
  const Line line(6);
  for (const std::size_t silent : {0U, 2U}) {
    std::vector<ProfilePass> passes;
    for (std::uint64_t k = 0; k < 3; ++k) passes.push_back(stroke_over(line, {.seed = 80 + k}));
    passes[silent].frequency_cycles_per_mm.clear();
    passes[silent].noise_psd_m2_mm.clear();
    const MergedProfile merge = merge_passes(passes, {});
    ASSERT_EQ(merge.used, 3U) << silent;
    EXPECT_NEAR(error_rms_m(merge, line), 0.9 * 3e-6 / std::sqrt(3.0), 0.25e-6) << silent;
    for (const MergedPass& pass : merge.passes) EXPECT_NEAR(pass.weight, 1.0 / 3.0, 0.01) << silent;
    EXPECT_TRUE(std::isnan(merge.noise.snr)) << silent;
  }
}

// RMS difference of the line's places that a merge lays on one another, of its first and its second pass.
double misplaced_rms_m(const MergedProfile& merge, const Stroke& first, const Stroke& second) {
  const std::vector<double>&a = merge.passes[0].on_merge, &b = merge.passes[1].on_merge;
  double square = 0.0, count = 0.0;
  std::size_t j = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    while (j + 2 < b.size() && !(b[j + 1] > a[i])) ++j;
    if (!(b[j] <= a[i]) || !(b[j + 1] >= a[i])) continue;
    const double at = static_cast<double>(j) + (a[i] - b[j]) / (b[j + 1] - b[j]);
    square += std::pow(place_m(first, kSpacing_m * static_cast<double>(i)) - place_m(second, kSpacing_m * at), 2);
    count += 1.0;
  }
  EXPECT_GT(count, 500.0);
  return std::sqrt(square / count);
}

// Without a stated noise, frequencies with noise alone must not lead the places. The same noise, stated, is the
// measure.
TEST(MergePasses, NoiseThatIsNotStatedDoesNotLeadThePlaces) {
  double unstated2 = 0.0, stated2 = 0.0, worst_m = 0.0;
  constexpr int kTrials = 6;
  for (int i = 0; i < kTrials; ++i) {
    const auto seed = static_cast<std::uint64_t>(300 + 2 * i);
    const Line line(seed, 20e-6, 1.5);  // of the band's 4 cycles/mm the others hold noise alone
    const Stroke a{.noise_m = 12e-6, .seed = seed}, b{.shift_m = 0.7e-3, .noise_m = 12e-6, .seed = seed + 1};
    std::vector<ProfilePass> passes{stroke_over(line, a), stroke_over(line, b)};
    for (ProfilePass& pass : passes) pass.place_sigma_m = 0.05e-3;
    const MergedProfile known = merge_passes(passes, {});
    for (ProfilePass& pass : passes) {
      pass.frequency_cycles_per_mm.clear();
      pass.noise_psd_m2_mm.clear();
    }
    const MergedProfile merge = merge_passes(passes, {});
    ASSERT_TRUE(merge.agrees && known.agrees) << i;
    const double off_m = misplaced_rms_m(merge, a, b);
    worst_m = std::max(worst_m, off_m);
    unstated2 += off_m * off_m / kTrials;
    stated2 += std::pow(misplaced_rms_m(known, a, b), 2) / kTrials;
  }
  // The noise's spectrum is estimated from a few segments: a third more than who is told it.
  EXPECT_LT(std::sqrt(unstated2), 1.33 * std::sqrt(stated2));
  EXPECT_LT(worst_m, 0.1e-3);
}

// Ten passes are 45 pairs: each pair's part of the chance is a 45th, by the normal distribution's tail.
TEST(MergePasses, TheChanceOfAFalseAgreementIsThatOfAllPairs) {
  std::vector<ProfilePass> passes;
  for (std::uint64_t seed = 1000; seed < 1020; seed += 2)
    passes.push_back(stroke_over(Line(seed), {.seed = seed + 1}, 700));
  AlignPassesConfig config;
  config.max_stretch = 0.0;
  const MergedProfile merge = merge_passes(passes, config);
  EXPECT_FALSE(merge.agrees);
  const auto tail = [](double sigmas) { return 0.5 * std::erfc(sigmas / std::sqrt(2.0)); };
  const double of_pair = tail(align_passes(passes[0], passes[1], config).threshold);
  const bool is_first = merge.passes[0].alignment.threshold > 0.0;  // of the reference itself there is none
  EXPECT_NEAR(of_pair / tail(merge.passes[is_first ? 0 : 1].alignment.threshold), 45.0, 0.5);
}

// Where the equations have no solution, as the squares of a height that is no height overflow, that is said.
TEST(WarpPass, SaysThatPlacesWereNotFound) {
  const PassSignal one = pass_signal(stroke_over(Line(12), {.seed = 120})),
                   same = pass_signal(stroke_over(Line(12), {.seed = 121}));
  PassSignal broken = same;
  broken.height_m[900] = 1e200;
  const WarpTarget target{one.height_m, one.known, one.frequency, one.noise, true};
  std::vector<double> places(one.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<double>(i);
  const WarpedPlaces right = warp_pass(target, same, places, {0.02, 5.0}, {});
  EXPECT_TRUE(right.converged);
  for (std::size_t i = 100; i + 100 < places.size(); ++i) ASSERT_NEAR(right.places[i], places[i], 1.0);
  EXPECT_FALSE(warp_pass(target, broken, places, {0.02, 5.0}, {}).converged);
}

TEST(MergePasses, LeavesOutTheStrokeOverAnotherLine) {
  const Line line(7), other(8);
  const std::vector<ProfilePass> passes{stroke_over(other, {.seed = 70}), stroke_over(line, {.seed = 71}),
                                        stroke_over(line, {.seed = 72})};
  const MergedProfile merge = merge_passes(passes, {});
  EXPECT_TRUE(merge.agrees);
  EXPECT_EQ(merge.used, 2U);
  EXPECT_FALSE(merge.passes[0].used);
  const MergedProfile none = merge_passes(std::span(passes).first(2), {});
  EXPECT_FALSE(none.agrees);
  EXPECT_EQ(none.used, 0U);
  EXPECT_TRUE(none.profile.texture_m.empty());
}

TEST(MergePasses, NamesWhatIsWrong) {
  const Line line(9);
  std::vector<ProfilePass> passes{stroke_over(line, {.seed = 90})};
  EXPECT_THROW(merge_passes(passes, {}), Error);
  passes.push_back(stroke_over(line, {.seed = 91}));
  passes[1].spacing_m *= 2.0;
  EXPECT_THROW(merge_passes(passes, {}), Error);
  passes[1] = stroke_over(line, {.seed = 91}, 20);
  EXPECT_THROW(merge_passes(passes, {}), Error);
  // 2¹⁵ points with the padding, and a knot each four of 30,000: 2²⁸ numbers.
  const ProfilePass whole = stroke_over(line, {.seed = 92}, 30'000), again = stroke_over(line, {.seed = 93}, 30'000);
  AlignPassesConfig close;
  close.knot_spacing_m = 1e-4;
  close.max_stretch = 0.0;
  EXPECT_THROW(merge_passes(std::vector<ProfilePass>{whole, again}, close), Error);
}

}  // namespace
}  // namespace asperity
