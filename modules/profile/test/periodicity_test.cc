#include "asperity/profile/find_periodicity.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;

// Holes of the given depth and diameter with steep walls.
std::vector<double> holes(double pitch_m, double depth_m, double diameter_m, double length_m, double noise_m) {
  Random random(3);
  std::vector<double> h;
  for (double s = 0.0; s < length_m; s += kSpacing_m) {
    const double from_centre = std::abs(std::remainder(s - 0.3 * pitch_m, pitch_m));
    const double wall = std::clamp((0.5 * diameter_m + 0.1e-3 - from_centre) / 0.2e-3, 0.0, 1.0);
    h.push_back(-depth_m * wall + noise_m * random.normal());
  }
  return h;
}

TEST(Periodicity, FindsPitchAndDepthOfAProtoboard) {
  for (const double pitch_m : {2.5e-3, 2.54e-3, 1.2e-3, 2.5117e-3}) {
    const Periodicity p = find_periodicity(holes(pitch_m, 0.94e-3, 0.5 * pitch_m, 0.08, 2e-6), kSpacing_m, {});
    EXPECT_TRUE(p.periodic);
    EXPECT_NEAR(p.pitch_m, pitch_m, 4e-4 * pitch_m);
    EXPECT_NEAR(p.depth_m, 0.94e-3, 12e-6);  // extremes of fifty noisy samples at top and bottom
    EXPECT_GT(p.strength, 0.95);
  }
}

TEST(Periodicity, TheStandardErrorIsTheSpread) {
  double square = 0.0, predicted = 0.0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    Random random(static_cast<std::uint64_t>(run) + 100);
    std::vector<double> h;
    double wander = 0.0;
    for (int k = 0; k < 3000; ++k) {
      // The arc length wanders by about 0.05 mm over some millimetres.
      wander += -wander / 120.0 + 6e-6 * random.normal();
      h.push_back(50e-6 * std::sin(2.0 * std::numbers::pi * (k * kSpacing_m + wander) / 1.5e-3) +
                  5e-6 * random.normal());
    }
    const Periodicity p = find_periodicity(h, kSpacing_m, {});
    square += std::pow(p.pitch_m - 1.5e-3, 2);
    predicted += p.pitch_stderr_m * p.pitch_stderr_m;
  }
  EXPECT_NEAR(std::sqrt(square / predicted), 1.0, 0.35);  // 60 runs, and an autocorrelation from 25 windows each
}

TEST(Periodicity, ALongProfileIsFollowedToItsEnd) {
  std::vector<double> h = holes(2.5117e-3, 0.9e-3, 1.2e-3, 1.2, 5e-6);
  for (std::size_t k = 0; k < 9000; ++k) h[k] = k % 3 == 0 ? h[k] : NAN;
  const Periodicity p = find_periodicity(h, kSpacing_m, {});
  EXPECT_TRUE(p.periodic);
  EXPECT_NEAR(p.pitch_m, 2.5117e-3, 5e-8);  // a hundredth of a period over all 478 would be 5e-8
}

TEST(Periodicity, GapsAreLeftOut) {
  std::vector<double> h = holes(2.5e-3, 0.9e-3, 1.2e-3, 0.06, 1e-6);
  for (std::size_t k = 500; k < 560; ++k) h[k] = NAN;
  for (std::size_t k = 1300; k < 1500; ++k) h[k] = NAN;
  const Periodicity p = find_periodicity(h, kSpacing_m, {});
  EXPECT_TRUE(p.periodic);
  EXPECT_NEAR(p.pitch_m, 2.5e-3, 2e-6);
  EXPECT_NEAR(p.depth_m, 0.9e-3, 10e-6);
}

TEST(Periodicity, RoughnessIsNotPeriodic) {
  Random random(8);
  std::vector<double> h;
  double x = 0.0;
  for (int k = 0; k < 4000; ++k) {
    x += -x / 8.0 + random.normal() * 1e-5;
    h.push_back(x);
  }
  EXPECT_FALSE(find_periodicity(h, kSpacing_m, {}).periodic);
  EXPECT_FALSE(find_periodicity(std::vector<double>(4000, NAN), kSpacing_m, {}).periodic);
  EXPECT_FALSE(find_periodicity(std::vector<double>(4000, 1e-3), kSpacing_m, {}).periodic);
  EXPECT_FALSE(find_periodicity({}, kSpacing_m, {}).periodic);
  EXPECT_THROW(find_periodicity(h, 0.0, {}), Error);
}

TEST(Periodicity, OfAShortProfileOfNoiseIsAPeriodOfIt) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Random random(seed);
    std::vector<double> h(40 + seed % 200);
    double x = 0.0;
    for (double& height_m : h) height_m = x = 0.9 * x + 1e-6 * random.normal();
    const Periodicity p = find_periodicity(h, kSpacing_m, {});
    if (std::isnan(p.pitch_m)) continue;
    EXPECT_GT(p.pitch_m, 2.0 * kSpacing_m) << "seed " << seed;
    EXPECT_LT(p.pitch_m, kSpacing_m * static_cast<double>(h.size())) << "seed " << seed;
  }
}

}  // namespace
}  // namespace asperity
