#include "asperity/profile/pattern_element_width.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 25e-6;
constexpr double kTurn = 2.0 * std::numbers::pi;

// Ribs of uneven height and place over 20 periods of 2.4 mm, with a second rib of `second` of the first's height.
std::vector<double> make_ribs(double second, std::uint64_t seed) {
  constexpr double kPitch_m = 2.4e-3;
  constexpr int kRibs = 20;
  Random random(seed, 0);
  std::vector<double> out(static_cast<std::size_t>(kRibs * kPitch_m / kSpacing_m), 0.0);
  for (int k = 0; k < kRibs; ++k) {
    for (const double part : {0.25, 0.75}) {
      const double height_m = 100e-6 * (1.0 + 0.05 * random.normal()) * (part < 0.5 ? 1.0 : second);
      const double at_m = (k + part) * kPitch_m + 10e-6 * random.normal();
      for (std::size_t i = 0; i < out.size(); ++i) {
        const double x = (static_cast<double>(i) * kSpacing_m - at_m) / 0.25e-3;
        if (std::abs(x) < 8.0) out[i] += height_m * std::exp(-0.5 * x * x);
      }
    }
  }
  return out;
}

Periodicity pattern_of(double pitch_m, std::size_t periods) {
  Periodicity out;
  out.periodic = true;
  out.pitch_m = pitch_m;
  out.pitch_stderr_m = 2e-3 * pitch_m;
  out.periods = periods;
  return out;
}

TextureNoise noise_of(double rms_m) {
  TextureNoise out;
  out.noise_rms_m = rms_m;
  out.noise_rms_stderr_m = 0.05 * rms_m;
  return out;
}

// The oracle is RSm of the heights without their noise, element by element.
TEST(PatternElementWidth, IsThatOfTheSurfaceUnderNoise) {
  constexpr double kNoise_m = 15e-6;
  int determined = 0, held = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const double second = seed % 3 == 0 ? 0.0 : seed % 3 == 1 ? 0.6 : 1.0;
    std::vector<double> heights_m = make_ribs(second, seed);
    const double true_m = measure_roughness(heights_m, kSpacing_m).RSm_m;
    Random random(seed, 1);
    double slow_m = 0.0;
    for (double& h : heights_m) {
      // Noise of 0.2 mm along the path.
      slow_m += -0.125 * slow_m + std::sqrt(0.234) * kNoise_m * random.normal();
      h += slow_m;
    }
    const ElementWidth width = pattern_element_width(heights_m, kSpacing_m, pattern_of(2.4e-3, 20), noise_of(kNoise_m));
    if (!std::isfinite(width.mean_m)) continue;
    ++determined;
    held += std::abs(width.mean_m - true_m) < 1.96 * width.stderr_m ? 1 : 0;
  }
  EXPECT_GE(determined, 50);
  EXPECT_GE(held, (determined * 9) / 10);
}

// sin x + a sin 2x crosses its mean twice a period more where a > 1/2, by hills that are 15 % of Rz for a = 1.2.
std::vector<double> make_waves(double a) {
  std::vector<double> out;
  for (int i = 0; i < 2000; ++i) {
    const double x = kTurn * i * kSpacing_m / 2.5e-3;
    out.push_back(100e-6 * (std::sin(x) + a * std::sin(2.0 * x)));
  }
  return out;
}

TEST(PatternElementWidth, IsNotDeterminedWhereTheNumberOfElementsIsNot) {
  const auto width_m = [](double a, double noise_m) {
    return pattern_element_width(make_waves(a), kSpacing_m, pattern_of(2.5e-3, 20), noise_of(noise_m)).mean_m;
  };
  EXPECT_NEAR(width_m(0.3, 5e-6), 2.5e-3, 1e-9);
  EXPECT_NEAR(width_m(4.0, 5e-6), 1.25e-3, 1e-9);
  EXPECT_FALSE(std::isfinite(width_m(1.2, 5e-6)));    // 15 % of Rz is between one tenth and two
  EXPECT_FALSE(std::isfinite(width_m(0.3, 300e-6)));  // the mean period's noise is 67 µm
}

// Roughness of 15 % of the ribs' height that does not repeat splits elements, which the mean period does not show.
TEST(PatternElementWidth, IsNotDeterminedWhereRoughnessMaySplitElements) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::vector<double> heights_m = make_ribs(0.0, seed);
    Random random(seed, 2);
    double rough_m = 0.0;
    for (double& h : heights_m) {
      rough_m += -0.25 * rough_m + std::sqrt(0.4375) * 15e-6 * random.normal();
      h += rough_m;
    }
    EXPECT_FALSE(
        std::isfinite(pattern_element_width(heights_m, kSpacing_m, pattern_of(2.4e-3, 20), noise_of(3e-6)).mean_m));
  }
}

TEST(PatternElementWidth, NothingHasNone) {
  const std::vector<double> heights_m(2000, 0.0);
  EXPECT_FALSE(std::isfinite(pattern_element_width(heights_m, kSpacing_m, {}, noise_of(1e-6)).mean_m));
  EXPECT_FALSE(
      std::isfinite(pattern_element_width(heights_m, kSpacing_m, pattern_of(2.5e-3, 20), noise_of(1e-6)).mean_m));
  const std::vector<double> gaps(2000, kNan);
  EXPECT_FALSE(std::isfinite(pattern_element_width(gaps, kSpacing_m, pattern_of(2.5e-3, 20), noise_of(1e-6)).mean_m));
}

}  // namespace
}  // namespace asperity
