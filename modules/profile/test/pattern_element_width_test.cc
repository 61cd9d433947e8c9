#include "asperity/profile/pattern_element_width.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "asperity/profile/find_periodicity_under_noise.h"

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

// Straight ribs of uneven height and place, `turned_rad` from the chord of an arc of 80 mm that turns by 0.9 rad.
struct RibsUnderAnArc {
  std::vector<Eigen::Vector2d> path_m;
  std::vector<double> heights_m;
};

RibsUnderAnArc ribs_under_an_arc(double turned_rad, double pitch_m, std::uint64_t seed) {
  constexpr std::size_t kPoints = 3200;
  constexpr double kRadius_m = 80e-3 / 0.9;
  RibsUnderAnArc out;
  out.heights_m.assign(kPoints, 0.0);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double angle = kSpacing_m * static_cast<double>(i) / kRadius_m - 0.45;
    out.path_m.emplace_back(kRadius_m * std::sin(angle), kRadius_m * std::cos(angle));
  }
  Random random(seed, 3);
  const Eigen::Vector2d normal(std::cos(turned_rad), std::sin(turned_rad));
  for (double at_m = -0.1; at_m < 0.15; at_m += pitch_m) {
    const double height_m = 100e-6 * (1.0 + 0.05 * random.normal()), place_m = at_m + 5e-6 * random.normal();
    for (std::size_t i = 0; i < kPoints; ++i) {
      const double x = (normal.dot(out.path_m[i]) - place_m) / (0.15 * pitch_m);
      if (std::abs(x) < 8.0) out.heights_m[i] += height_m * std::exp(-0.5 * x * x);
    }
  }
  return out;
}

// The oracle is RSm along the path of the heights without their noise, element by element.
TEST(PatternElementWidth, OfRibsUnderABentPathIsTheMeanAlongThePath) {
  constexpr double kNoise_m = 12e-6, kPitch_m = 1.6e-3;
  int determined = 0, held = 0, scans = 0;
  for (const double turned_rad : {0.0, 0.2, -0.3}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed, ++scans) {
      RibsUnderAnArc ribs = ribs_under_an_arc(turned_rad, kPitch_m, seed);
      const double true_m = measure_roughness(ribs.heights_m, kSpacing_m).RSm_m;
      Random random(seed, 4);
      for (double& h : ribs.heights_m) h += kNoise_m * random.normal();
      TextureNoise noise = noise_of(kNoise_m);
      noise.frequency_cycles_per_mm = {0.0, 20.0};
      noise.added_psd_m2_mm = {kNoise_m * kNoise_m / 20.0, kNoise_m * kNoise_m / 20.0};
      noise.misplaced_psd_m2_mm = {0.0, 0.0};
      noise.added_rms_m = kNoise_m;
      noise.added_rms_stderr_m = noise.noise_rms_stderr_m;
      const Periodicity pattern = find_periodicity_under_noise(ribs.heights_m, kSpacing_m, noise, {}, ribs.path_m);
      const ElementWidth width =
          pattern_element_width(ribs.heights_m, kSpacing_m, pattern, noise, RoughnessConfig{}, ribs.path_m);
      if (!std::isfinite(width.mean_m)) continue;
      ++determined;
      held += std::abs(width.mean_m - true_m) < 1.96 * width.stderr_m ? 1 : 0;
      EXPECT_LT(width.stderr_m, 0.04 * width.mean_m);  // one element of some 50, and the pitch's error
    }
  }
  EXPECT_GE(determined, (scans * 3) / 4);
  EXPECT_GE(held, (determined * 9) / 10);
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
