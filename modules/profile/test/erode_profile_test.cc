#include "asperity/profile/erode_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kTip_m = 0.32e-3;
constexpr double kStep_m = 0.025e-3;

// Ridges with sharp tops, as a ball rolls over them: by the definition.
std::vector<double> traced_ridges(std::size_t points, double depth_m, double pitch_m, double radius_m) {
  std::vector<double> z_m(points), out(points);
  for (std::size_t i = 0; i < points; ++i)
    z_m[i] = -depth_m * std::abs(std::sin(3.14159265358979 * static_cast<double>(i) * kStep_m / pitch_m));
  for (std::size_t i = 0; i < points; ++i) {
    out[i] = z_m[i];
    for (std::size_t j = 0; j < points; ++j) {
      const double u_m = kStep_m * (static_cast<double>(j) - static_cast<double>(i));
      if (std::abs(u_m) <= radius_m)
        out[i] = std::max(out[i], z_m[j] + std::sqrt(radius_m * radius_m - u_m * u_m) - radius_m);
    }
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

TextureNoise white_noise(double rms_m) {
  TextureNoise noise;
  noise.frequency_cycles_per_mm = {0.0, 4.0};
  noise.added_psd_m2_mm = {rms_m * rms_m / 4.0, rms_m * rms_m / 4.0};
  noise.noise_rms_m = rms_m;
  return noise;
}

TEST(ErodeProfile, FindsTheSurfaceUnderSharpRidges) {
  const ErodedProfile eroded =
      erode_profile(profile_of(traced_ridges(1000, 0.1e-3, 1e-3, kTip_m)), white_noise(0.0), kTip_m);
  ASSERT_TRUE(eroded.determined);
  double worst_m = 0.0;
  for (std::size_t i = 40; i < 960; ++i) {
    const double z_m = -0.1e-3 * std::abs(std::sin(3.14159265358979 * static_cast<double>(i) * kStep_m / 1e-3));
    if (eroded.touched[i] != 0) worst_m = std::max(worst_m, std::abs(eroded.surface_m[i] - z_m));
  }
  EXPECT_LT(worst_m, 2e-6);  // two spacings on a slope that the ball meets
  EXPECT_GT(eroded.touched_share, 0.5);
  EXPECT_GT(eroded.correction_rms_m, 5e-6);
}

TEST(ErodeProfile, TakesOffWhatNoiseDoes) {
  const std::vector<double> d_m = traced_ridges(2000, 0.1e-3, 1e-3, kTip_m);
  const auto with_noise = [&](double rms_m) {
    Random random(5, 0);
    std::vector<double> noisy_m = d_m;
    for (double& h : noisy_m) h += rms_m * random.normal();
    TextureNoise noise = white_noise(rms_m);
    noise.frequency_cycles_per_mm.back() = 20.0;
    for (double& density : noise.added_psd_m2_mm) density *= 0.2;
    return erode_profile(profile_of(noisy_m), noise, kTip_m);
  };
  const ErodedProfile quiet = with_noise(1e-6);
  ASSERT_TRUE(quiet.determined);
  EXPECT_LT(quiet.bias_m, 0.0);
  const ErodedProfile clean = erode_profile(profile_of(d_m), white_noise(0.0), kTip_m);
  double error_m = 0.0, uncorrected_m = 0.0;
  for (std::size_t i = 40; i + 40 < d_m.size(); ++i) {
    error_m += (quiet.surface_m[i] - clean.surface_m[i]) / 1920.0;
    uncorrected_m += (quiet.surface_m[i] + quiet.bias_m - clean.surface_m[i]) / 1920.0;
  }
  EXPECT_LT(std::abs(error_m), 0.5 * std::abs(uncorrected_m));
}

// The lowest of heights with a noise of which nothing is known is too low by nobody knows how much.
TEST(ErodeProfile, IsNotDeterminedWithoutAKnownNoise) {
  const ErodedProfile eroded = erode_profile(profile_of(traced_ridges(1000, 0.1e-3, 1e-3, kTip_m)), {}, kTip_m);
  EXPECT_FALSE(eroded.determined);
  EXPECT_EQ(eroded.reason, "the noise of the heights is not known");
}

TEST(ErodeProfile, IsNotDeterminedWithoutATip) {
  const ErodedProfile eroded = erode_profile(profile_of(std::vector<double>(100, 0.0)), {}, 0.0);
  EXPECT_FALSE(eroded.determined);
  EXPECT_FALSE(eroded.reason.empty());
}

}  // namespace
}  // namespace asperity
