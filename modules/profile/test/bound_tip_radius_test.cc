#include "asperity/profile/bound_tip_radius.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kStep_m = 0.025e-3;
constexpr double kTip_m = 0.32e-3;
constexpr std::size_t kPoints = 2000;

// Crests without a radius, as a ball rolls over them: by the definition, on a grid five times as fine.
std::vector<double> traced_crests(double radius_m) {
  constexpr int kFine = 5;
  const double fine_m = kStep_m / kFine;
  const auto z_m = [](double x_m) { return -0.1e-3 * std::abs(std::sin(std::numbers::pi * x_m / 1.3e-3)); };
  const int reach = static_cast<int>(radius_m / fine_m);
  std::vector<double> out;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double x_m = kStep_m * static_cast<double>(i);
    double top_m = -1.0;
    for (int k = -reach; k <= reach; ++k) {
      const double u_m = fine_m * k;
      top_m = std::max(top_m, z_m(x_m + u_m) + std::sqrt(radius_m * radius_m - u_m * u_m) - radius_m);
    }
    out.push_back(top_m);
  }
  return out;
}

Profile profile_of(std::vector<double> height_m) {
  Profile out;
  out.spacing_m = kStep_m;
  for (std::size_t i = 0; i < height_m.size(); ++i) out.s_m.push_back(kStep_m * static_cast<double>(i));
  out.height_m = std::move(height_m);
  return out;
}

TextureNoise white(double rms_m) {
  TextureNoise noise;
  noise.frequency_cycles_per_mm = {0.0, 20.0};
  noise.added_psd_m2_mm.assign(2, rms_m * rms_m / 20.0);
  noise.added_rms_m = rms_m;
  noise.added_rms_stderr_m = 0.0;
  return noise;
}

TEST(BoundTipRadius, OfSharpCrestsIsTheBall) {
  for (const double radius_m : {0.2e-3, 0.32e-3, 0.6e-3}) {
    const TipRadiusBound bound = bound_tip_radius(profile_of(traced_crests(radius_m)), white(1e-9));
    ASSERT_TRUE(bound.determined) << bound.reason;
    EXPECT_GE(bound.at_most_m, 0.999 * radius_m);
    EXPECT_LE(bound.at_most_m, 1.25 * radius_m);  // (1 + p²)^1.5 for slopes of up to 0.35 under the Gaussian
  }
}

TEST(BoundTipRadius, IsNoSmallerThanTheBallUnderNoise) {
  // 2.5 % of the bounds may be too small: 1 of 40 expected, 5 or more in 0.3 % of such tests.
  const std::vector<double> clean_m = traced_crests(kTip_m);
  constexpr int kTrials = 40;
  int too_small = 0;
  std::vector<double> bounds_m;
  for (int k = 0; k < kTrials; ++k) {
    Random random(100 + static_cast<std::uint64_t>(k), 0);
    std::vector<double> noisy_m = clean_m;
    for (double& h_m : noisy_m) h_m += 2e-6 * random.normal();
    const TipRadiusBound bound = bound_tip_radius(profile_of(noisy_m), white(2e-6));
    if (!bound.determined) continue;
    too_small += bound.at_most_m < kTip_m ? 1 : 0;
    bounds_m.push_back(bound.at_most_m);
  }
  EXPECT_LE(too_small, 4);
  ASSERT_GE(bounds_m.size(), 35U);
  std::sort(bounds_m.begin(), bounds_m.end());
  EXPECT_LT(bounds_m[bounds_m.size() / 2], 2.0 * kTip_m);
}

TEST(BoundTipRadius, NoiseNotCountedWouldMakeItTooSmall) {
  Random random(7, 0);
  std::vector<double> noisy_m = traced_crests(kTip_m);
  for (double& h_m : noisy_m) h_m += 2e-6 * random.normal();
  EXPECT_LT(bound_tip_radius(profile_of(noisy_m), white(1e-9)).at_most_m, 0.6 * kTip_m);
}

TEST(BoundTipRadius, OfABluntSurfaceSaysLittle) {
  // Waves of 0.1 mm and 6 mm: the crests have a radius of 1/(0.1 mm (2π/6 mm)²) = 9.1 mm.
  std::vector<double> height_m;
  for (std::size_t i = 0; i < kPoints; ++i)
    height_m.push_back(0.1e-3 * std::cos(2.0 * std::numbers::pi * kStep_m * static_cast<double>(i) / 6e-3));
  const TipRadiusBound bound = bound_tip_radius(profile_of(height_m), white(1e-9));
  ASSERT_TRUE(bound.determined);
  EXPECT_NEAR(bound.at_most_m, 9.1e-3, 0.3e-3);
}

TEST(BoundTipRadius, WithoutNoiseOrPeaksThereIsNone) {
  EXPECT_FALSE(bound_tip_radius(profile_of(traced_crests(kTip_m)), {}).determined);
  Random random(8, 0);
  std::vector<double> noise_m(kPoints);
  for (double& h_m : noise_m) h_m = 2e-6 * random.normal();
  const TipRadiusBound bound = bound_tip_radius(profile_of(noise_m), white(2.4e-6));
  EXPECT_FALSE(bound.determined && bound.at_most_m < 5e-3) << bound.at_most_m;
  // A gap is no peak.
  std::vector<double> gap_m(kPoints, 0.0);
  for (std::size_t i = 900; i < 950; ++i) gap_m[i] = std::nan("");
  EXPECT_FALSE(bound_tip_radius(profile_of(gap_m), white(1e-6)).determined);
}

}  // namespace
}  // namespace asperity
