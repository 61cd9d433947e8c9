#include "asperity/profile/estimate_texture_noise.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/nan.h"
#include "asperity/base/random.h"
#include "asperity/profile/measure_error_floor.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;
constexpr double kSpeed_mps = 0.025;
constexpr double kCutoff_cycles_per_mm = 0.1;

// 80 mm at an even speed, a sine of 1 cycle/mm with an RMS of 50 µm.
Profile even_stretch() {
  Profile out;
  const std::size_t n = 3201;
  out.spacing_m = kSpacing_m;
  for (std::size_t i = 0; i < n; ++i) {
    out.s_m.push_back(kSpacing_m * static_cast<double>(i));
    out.texture_m.push_back(50e-6 * std::numbers::sqrt2 * std::sin(2.0 * std::numbers::pi * 1e3 * out.s_m.back()));
  }
  out.height_m = out.texture_m;
  out.speed_mps.assign(n, kSpeed_mps);
  return out;
}

// ∫ v A (2πkv)⁻⁴ (1 + c (k₀/k)⁴)⁻² dk over all k, with ∫ x⁴ (1 + x⁴)⁻² dx = π √2/16.
TEST(TextureNoise, OfAnAccelerometerAloneHasAClosedForm) {
  const double accel_psd = 1e-5;
  const TextureNoiseEstimate estimate = estimate_texture_noise(even_stretch(), {accel_psd, 1e3}, kCutoff_cycles_per_mm);
  const double corner_Hz = 1e3 * kCutoff_cycles_per_mm * kSpeed_mps * std::pow(std::numbers::sqrt2 - 1.0, 0.25);
  const double power_m2 = accel_psd / std::pow(2.0 * std::numbers::pi, 4) / std::pow(corner_Hz, 3) * std::numbers::pi *
                          std::numbers::sqrt2 / 16.0;
  EXPECT_NEAR(estimate.noise.added_rms_m, std::sqrt(power_m2), 0.01 * std::sqrt(power_m2));
  EXPECT_EQ(estimate.noise.noise_rms_m, estimate.noise.added_rms_m);
  EXPECT_NEAR(estimate.texture_sigma_m[1600], estimate.noise.noise_rms_m, 1e-3 * estimate.noise.noise_rms_m);
  const double snr = 2500e-12 / power_m2 - 1.0;
  EXPECT_NEAR(estimate.noise.snr, snr, 0.03 * (snr + 1.0));
}

// Where the accelerometer says nothing, the tracker's white noise goes through from the cut-off to 20 cycles/mm.
TEST(TextureNoise, OfATrackerAloneIsWhite) {
  const double tracker_psd = 1e-10;
  const TextureNoiseEstimate estimate =
      estimate_texture_noise(even_stretch(), {1e12, tracker_psd}, kCutoff_cycles_per_mm);
  const double power_m2 = tracker_psd * 1e3 * kSpeed_mps * (20.0 - 0.1);
  EXPECT_NEAR(estimate.noise.noise_rms_m, std::sqrt(power_m2), 0.01 * std::sqrt(power_m2));
}

// A sine seen where it is not: σ² = R f_c π/(2√2), and 2 (1 − exp(−(2πkσ)²/2)) of its power are wrong.
TEST(TextureNoise, OfHeightsAtAWrongPlaceGrowsWithTheFrequency) {
  const double accel_psd = 1e-6, tracker_psd = 4e-10;
  const TextureNoiseEstimate estimate =
      estimate_texture_noise(even_stretch(), {1e-12, 1e-9, accel_psd, tracker_psd}, kCutoff_cycles_per_mm);
  const double meeting_Hz = std::pow(accel_psd / tracker_psd, 0.25) / (2.0 * std::numbers::pi);
  const double bandwidth_Hz = meeting_Hz * std::numbers::pi / (2.0 * std::numbers::sqrt2);
  const double shape_mm = 1e3 * std::sqrt(tracker_psd * (bandwidth_Hz - 0.5 / (0.08 / kSpeed_mps)));
  EXPECT_NEAR(1e3 * estimate.noise.place_sigma_m, shape_mm, 0.001 * shape_mm);
  const double phase = 2.0 * std::numbers::pi * shape_mm;
  const double expected_m = 50e-6 * std::sqrt(2.0 * (1.0 - std::exp(-0.5 * phase * phase)));
  // The spectrum's lines spread the sine by 0.04 cycles/mm to either side.
  EXPECT_NEAR(estimate.noise.noise_rms_m, expected_m, 0.05 * expected_m);
  EXPECT_LT(estimate.noise.added_rms_m, 0.01 * expected_m);
  EXPECT_NEAR(1e3 * estimate.noise.length_stderr_m, 1e3 * std::sqrt(2.0 * tracker_psd * bandwidth_Hz), 1e-4);
}

// Twice as fast over half of the way: that half has the noise of waves of half the length in time, f⁻³ of the power.
TEST(TextureNoise, FollowsTheSpeedPointByPoint) {
  Profile profile = even_stretch();
  for (std::size_t i = 1600; i < profile.size(); ++i) profile.speed_mps[i] = 2.0 * kSpeed_mps;
  const TextureNoiseEstimate estimate = estimate_texture_noise(profile, {1e-5, 1e3}, kCutoff_cycles_per_mm);
  EXPECT_NEAR(estimate.texture_sigma_m[800] / estimate.texture_sigma_m[2400], std::pow(2.0, 1.5), 0.01);
}

TEST(TextureNoise, SaysNothingWhereNoNoiseIsKnown) {
  Profile profile = even_stretch();
  profile.texture_m[5] = kNan;
  const TextureNoiseEstimate nothing = estimate_texture_noise(profile, {}, kCutoff_cycles_per_mm);
  EXPECT_TRUE(std::isnan(nothing.noise.noise_rms_m));
  EXPECT_TRUE(std::isnan(nothing.noise.snr));
  EXPECT_NEAR(nothing.noise.texture_rms_m, 50e-6, 0.1e-6);
  const TextureNoiseEstimate some = estimate_texture_noise(profile, {1e-5, 1e-9}, kCutoff_cycles_per_mm);
  EXPECT_TRUE(std::isnan(some.texture_sigma_m[5]));
  EXPECT_GT(some.texture_sigma_m[6], 0.0);
}

// An acceleration of a line at 60 Hz in white noise: the floor is the noise's density, 2 σ²/rate, whatever the line.
TEST(ErrorFloor, OfAnAccelerationIsItsWhiteNoise) {
  constexpr double kRate_Hz = 1000.0, kSigma = 0.1;
  Random random(3);
  std::vector<double> t_s, x;
  for (int i = 0; i < 4000; ++i) {
    if (i % 500 < 3) continue;  // lost
    t_s.push_back(i / kRate_Hz);
    x.push_back(5.0 * std::sin(2.0 * std::numbers::pi * 60.0 * t_s.back()) + kSigma * random.normal());
  }
  const double expected = 2.0 * kSigma * kSigma / kRate_Hz;
  // The lowest of some twenty bands: up to 3 σ of their own chance below the mean.
  EXPECT_GT(acceleration_floor_m2ps3(t_s, x, {}), 0.6 * expected);
  EXPECT_LT(acceleration_floor_m2ps3(t_s, x, {}), 1.05 * expected);
  EXPECT_EQ(acceleration_floor_m2ps3(t_s, x, std::vector<char>(x.size(), 0)), 0.0);
}

// A height that is quieter than the tracker bounds the acceleration's noise; one that is louder does not.
TEST(ErrorFloor, IsBoundedByWhatTheHeightHasInIt) {
  constexpr double kRate_Hz = 500.0;
  std::vector<double> t_s, still, moving;
  Random random(4);
  double value = 0.0, speed = 0.0;
  const double accel_psd = 1e-6;
  for (int i = 0; i < 8000; ++i) {
    t_s.push_back(i / kRate_Hz);
    // White acceleration twice integrated, held by a spring and a damper far below 1.6 Hz.
    speed += (std::sqrt(0.5 * accel_psd * kRate_Hz) * random.normal() - speed - value) / kRate_Hz;
    value += speed / kRate_Hz;
    still.push_back(value);
    moving.push_back(1e-3 * std::sin(2.0 * std::numbers::pi * 2.0 * t_s.back()) + 1e-3 * random.normal());
  }
  const double bound = largest_acceleration_noise_m2ps3(t_s, still, {}, 1e-6);
  EXPECT_GT(bound, 0.8 * accel_psd);
  EXPECT_LT(bound, 3.0 * accel_psd);
  EXPECT_TRUE(std::isinf(largest_acceleration_noise_m2ps3(t_s, moving, {}, 1e-9)));
}

}  // namespace
}  // namespace asperity
