#include "asperity/profile/estimate_texture_noise.h"
#include "asperity/profile/height_error_density.h"

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

HeightErrors errors_of(double accel_psd, double tracker_psd, double along_accel_psd = 0.0,
                       double along_tracker_psd = 0.0) {
  HeightErrors out;
  out.accel_psd_m2ps3 = accel_psd;
  out.tracker_psd_m2ps = tracker_psd;
  out.along_accel_psd_m2ps3 = along_accel_psd;
  out.along_tracker_psd_m2ps = along_tracker_psd;
  return out;
}

// With so many draws that their chance is some percent.
TextureNoiseEstimate many(const HeightErrors& errors) {
  TextureNoiseConfig config;
  config.draws = 600;
  return estimate_texture_noise(even_stretch(), errors, kCutoff_cycles_per_mm, config);
}

// Over the middle half, where the high-pass has both its sides.
double inner_rms_m(const std::vector<double>& sigma_m) {
  double sum = 0.0;
  for (std::size_t i = 800; i < 2400; ++i) sum += sigma_m[i] * sigma_m[i];
  return std::sqrt(sum / 1600.0);
}

// ∫ v A (2πkv)⁻⁴ (1 + c (k₀/k)⁴)⁻² dk over all k, with ∫ x⁴ (1 + x⁴)⁻² dx = π √2/16.
TEST(TextureNoise, OfAnAccelerometerAloneHasAClosedForm) {
  const double accel_psd = 1e-5;
  const TextureNoiseEstimate estimate = many(errors_of(accel_psd, 1e3));
  const double corner_Hz = 1e3 * kCutoff_cycles_per_mm * kSpeed_mps * std::pow(std::numbers::sqrt2 - 1.0, 0.25);
  const double power_m2 = accel_psd / std::pow(2.0 * std::numbers::pi, 4) / std::pow(corner_Hz, 3) * std::numbers::pi *
                          std::numbers::sqrt2 / 16.0;
  // 1.6 s of noise about 2 Hz have some four independent values: √(2/4) of the power a draw, 1.4 % of the RMS in all.
  EXPECT_NEAR(inner_rms_m(estimate.noise.added_sigma_m), std::sqrt(power_m2), 0.04 * std::sqrt(power_m2));
  // Over all of the path, without the noisiest tenth: the ends, where the filter has one side only.
  EXPECT_NEAR(estimate.noise.typical_added_rms_m, std::sqrt(power_m2), 0.1 * std::sqrt(power_m2));
  const double snr = 2500e-12 / power_m2 - 1.0;
  EXPECT_NEAR(estimate.noise.snr, snr, 0.2 * (snr + 1.0));
  // The draws of a usual run differ by their chance: √(2/8/24) of the power.
  const TextureNoiseEstimate usual =
      estimate_texture_noise(even_stretch(), errors_of(accel_psd, 1e3), kCutoff_cycles_per_mm);
  EXPECT_NEAR(inner_rms_m(usual.noise.added_sigma_m), std::sqrt(power_m2), 0.2 * std::sqrt(power_m2));
}

// A sine of 1 cycle/mm over 80 mm, all of whose power is at its own frequency: g(πkσL) there.
TEST(TextureNoise, AStretchLowersTheCorrelationOfTheTextureAlone) {
  HeightErrors errors = errors_of(1e-8, 1e-12);
  const TextureNoiseEstimate without = estimate_texture_noise(even_stretch(), errors, kCutoff_cycles_per_mm);
  EXPECT_DOUBLE_EQ(without.noise.stretch_correlation, 1.0);
  errors.stretch_sigma = 0.005;
  const TextureNoiseEstimate with = estimate_texture_noise(even_stretch(), errors, kCutoff_cycles_per_mm);
  const double a = std::numbers::pi * 0.005 * 80.0;
  EXPECT_NEAR(with.noise.stretch_correlation, std::sqrt(0.5 * std::numbers::pi) * std::erf(a / std::numbers::sqrt2) / a,
              0.01);
  EXPECT_NEAR(with.noise.end_place_sigma_m, 0.2e-3, 1e-6);
  EXPECT_DOUBLE_EQ(with.noise.noise_rms_m, without.noise.noise_rms_m);
  EXPECT_DOUBLE_EQ(with.noise.snr, without.noise.snr);
}

// Single points beside a gap have no speed: their error is like that of their neighbours.
TEST(TextureNoise, PointsWithoutASpeedHaveASigma) {
  Profile profile = even_stretch();
  for (std::size_t i = 1000; i < 1060; ++i) profile.height_m[i] = profile.texture_m[i] = profile.speed_mps[i] = kNan;
  profile.height_m[1030] = profile.texture_m[1030] = 1e-6;
  const TextureNoiseEstimate estimate = estimate_texture_noise(profile, errors_of(1e-5, 1e-9), kCutoff_cycles_per_mm);
  EXPECT_GT(estimate.texture_sigma_m[1030], 0.3 * estimate.texture_sigma_m[900]);
  EXPECT_TRUE(std::isnan(estimate.texture_sigma_m[1010]));
}

// Where the accelerometer says nothing, the tracker's white noise goes through from the cut-off to 20 cycles/mm.
TEST(TextureNoise, OfATrackerAloneIsWhite) {
  const double tracker_psd = 1e-12;
  const TextureNoiseEstimate estimate = many(errors_of(1e12, tracker_psd));
  const double power_m2 = tracker_psd * 1e3 * kSpeed_mps * (20.0 - 0.1);
  // A thousand independent values a draw: 0.1 % in all. Points are 1 ms apart, as the noise's numbers are.
  EXPECT_NEAR(inner_rms_m(estimate.noise.added_sigma_m), std::sqrt(power_m2), 0.01 * std::sqrt(power_m2));
}

// A sine seen where it is not: σ² = R f_c π/(2√2), and 2 (1 − exp(−(2πkσ)²/2)) of its power are wrong.
TEST(TextureNoise, OfHeightsAtAWrongPlaceGrowsWithTheFrequency) {
  const double accel_psd = 1e-6, tracker_psd = 4e-10;
  const TextureNoiseEstimate estimate = many(errors_of(1e-12, 1e-9, accel_psd, tracker_psd));
  const double meeting_Hz = std::pow(accel_psd / tracker_psd, 0.25) / (2.0 * std::numbers::pi);
  const double bandwidth_Hz = meeting_Hz * std::numbers::pi / (2.0 * std::numbers::sqrt2);
  const double shape_mm = 1e3 * std::sqrt(tracker_psd * (bandwidth_Hz - 0.5 / (0.08 / kSpeed_mps)));
  EXPECT_NEAR(1e3 * estimate.noise.place_sigma_m, shape_mm, 0.02 * shape_mm);
  const double phase = 2.0 * std::numbers::pi * shape_mm;
  const double expected_m = 50e-6 * std::sqrt(2.0 * (1.0 - std::exp(-0.5 * phase * phase)));
  // Over 24 seeds of the draws the ratio was 1.000 with a standard deviation of 1.0 %: three of them.
  EXPECT_NEAR(inner_rms_m(estimate.noise.misplaced_sigma_m), expected_m, 0.03 * expected_m);
  // Over all of the path, by the blocks' points.
  EXPECT_NEAR(estimate.noise.typical_misplaced_rms_m, expected_m, 0.05 * expected_m);
  EXPECT_LT(estimate.noise.added_rms_m, 0.01 * expected_m);
  EXPECT_NEAR(1e3 * estimate.noise.length_stderr_m, 1e3 * std::sqrt(2.0 * tracker_psd * bandwidth_Hz), 1e-4);
}

// Twice as fast over half of the way: that half has the noise of waves of half the length in time, f⁻³ of the power.
TEST(TextureNoise, FollowsTheSpeedPointByPoint) {
  Profile profile = even_stretch();
  for (std::size_t i = 1600; i < profile.size(); ++i) profile.speed_mps[i] = 2.0 * kSpeed_mps;
  TextureNoiseConfig config;
  config.draws = 600;
  const TextureNoiseEstimate estimate =
      estimate_texture_noise(profile, errors_of(1e-5, 1e3), kCutoff_cycles_per_mm, config);
  for (const std::size_t from : {600U, 800U, 1000U, 1200U}) {
    EXPECT_NEAR(estimate.texture_sigma_m[from] / estimate.texture_sigma_m[3200 - from], std::pow(2.0, 1.5),
                0.05 * std::pow(2.0, 1.5));
  }
}

// What the normals' lean carries is a part of the added noise, at the frequencies where the tip sways.
TEST(TextureNoise, SaysWhatTheLeanCarries) {
  HeightErrors errors = errors_of(1e-6, 1e-9);
  const TextureNoiseEstimate upright = many(errors);
  EXPECT_TRUE(upright.noise.carried_psd_m2_mm.empty());
  errors.crosstalk_Hz = {0.0, 8.0, 10.0, 12.0, 500.0};
  errors.crosstalk_m2ps.assign(5, 0.0);
  errors.leaning_m2ps = {0.0, 0.0, 4e-12, 0.0, 0.0};  // 8 µm² about 10 Hz, 0.4 cycles/mm
  const TextureNoise noise = many(errors).noise;
  ASSERT_EQ(noise.carried_psd_m2_mm.size(), noise.added_psd_m2_mm.size());
  double carried_m2 = 0.0;
  for (std::size_t i = 0; i < noise.carried_psd_m2_mm.size(); ++i) {
    const double k = noise.frequency_cycles_per_mm[i];
    EXPECT_LE(noise.carried_psd_m2_mm[i], noise.added_psd_m2_mm[i]);
    if (k < 0.31 || k > 0.49) {
      EXPECT_EQ(noise.carried_psd_m2_mm[i], 0.0) << k;
    }
    if (i == 0) continue;
    carried_m2 += 0.5 * (noise.carried_psd_m2_mm[i] + noise.carried_psd_m2_mm[i - 1]) *
                  (k - noise.frequency_cycles_per_mm[i - 1]);
  }
  // The high-pass of 0.1 cycles/mm takes 0.3 % at 0.4. The spectrum's points are 6 % apart, the triangle 40 % wide.
  EXPECT_NEAR(carried_m2, 8e-12, 0.1 * 8e-12);
}

TEST(TextureNoise, SaysNothingWhereNoNoiseIsKnown) {
  Profile profile = even_stretch();
  profile.texture_m[5] = kNan;
  const TextureNoiseEstimate nothing = estimate_texture_noise(profile, {}, kCutoff_cycles_per_mm);
  EXPECT_TRUE(std::isnan(nothing.noise.noise_rms_m));
  EXPECT_TRUE(std::isnan(nothing.noise.snr));
  EXPECT_NEAR(nothing.noise.texture_rms_m, 50e-6, 0.1e-6);
  const TextureNoiseEstimate some = estimate_texture_noise(profile, errors_of(1e-5, 1e-9), kCutoff_cycles_per_mm);
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

// A tracker of density R and an acceleration whose noise of density A is far above (2πf)⁴ R at the low octaves: the
// best smoothing leaves R there, whatever A is. In short recordings, as scans are, the density of few ordinates is
// below R by chance, and must not be taken for a small A.
TEST(ErrorFloor, IsNotBoundedWhereTheTrackerAloneIsSeen) {
  constexpr double kRate_Hz = 400.0, kDuration_s = 3.0;
  constexpr double kAccel_m2ps3 = 0.02, kTracker_m2ps = 1e-9;  // they meet at 10.6 Hz
  constexpr auto kSamples = static_cast<int>(kRate_Hz * kDuration_s);
  int too_low = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    // The error that a Wiener smoother leaves, as a sum of waves with its density: they are 1/T apart.
    std::vector<double> t_s(kSamples), x(kSamples, 0.0);
    for (int i = 0; i < kSamples; ++i) t_s[i] = i / kRate_Hz;
    for (double f = 0.5 / kDuration_s; f < 60.0; f += 1.0 / kDuration_s) {
      const double w4 = std::pow(2.0 * std::numbers::pi * f, 4);
      const double density = kAccel_m2ps3 * kTracker_m2ps / (kAccel_m2ps3 + kTracker_m2ps * w4);
      const double a = std::sqrt(density / kDuration_s) * random.normal(),
                   b = std::sqrt(density / kDuration_s) * random.normal();
      for (int i = 0; i < kSamples; ++i) {
        const double phase = 2.0 * std::numbers::pi * f * t_s[i];
        x[i] += a * std::cos(phase) + b * std::sin(phase);
      }
    }
    if (largest_acceleration_noise_m2ps3(t_s, x, {}, kTracker_m2ps) < kAccel_m2ps3) ++too_low;
  }
  // Five octaves, each wrong in 1 %: 10 of 200. Twice that is 3 σ (binomial).
  EXPECT_LE(too_low, 20);
}

// White noise of density W lost over L samples and bridged by a straight line: the velocity is wrong by the line's mean
// of its two ends and by what was lost, p² σ² (L + L²/2) with σ² = W/(2p).
TEST(ErrorFloor, OfLostSamplesIsThatOfTheStraightLineOverThem) {
  constexpr double kRate_Hz = 500.0, kSigma = 2.0;
  Random random(5);
  std::vector<double> t_s, x;
  double gaps = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double value = kSigma * random.normal();
    if (i % 200 >= 100 && i % 200 < 105) {
      gaps += i % 200 == 100 ? 1.0 : 0.0;
      continue;
    }
    t_s.push_back(i / kRate_Hz);
    x.push_back(value);
  }
  const double square = std::pow(kSigma / kRate_Hz, 2) * (5.0 + 12.5);
  const double expected = 2.0 * gaps * square / (20000.0 / kRate_Hz);
  EXPECT_NEAR(gap_noise_m2ps3(t_s, x, {}, 0), expected, 0.1 * expected);
  const double one = std::pow(kSigma / kRate_Hz, 2) * 1.5;
  EXPECT_NEAR(gap_noise_m2ps3(t_s, x, {}, 400), expected + 2.0 * 400.0 * one / (20000.0 / kRate_Hz), 0.1 * expected);
}

// White noise folds as it is; what falls with f⁻⁴ over the highest octave is 16 times less at the sampling rate.
TEST(ErrorFloor, OfWhatFoldsFollowsTheSpectrumsFall) {
  constexpr double kRate_Hz = 1000.0;
  Random random(6);
  std::vector<double> t_s, white, fallen;
  double one = 0.0, two = 0.0;
  for (int i = 0; i < 60000; ++i) {
    t_s.push_back(i / kRate_Hz);
    white.push_back(random.normal());
    one += 0.3 * (white.back() - one);
    two += 0.3 * (one - two);
    fallen.push_back(two);
  }
  const double density = 2.0 / kRate_Hz;
  EXPECT_NEAR(folded_acceleration_m2ps3(t_s, white, {}), density, 0.15 * density);
  // Power of the low-pass 0.3/(1 − 0.7 z⁻¹), squared, at the middles of the two bands: 443 and 221 Hz.
  const auto power = [](double f) {
    const double c = std::cos(2.0 * std::numbers::pi * f / kRate_Hz);
    return std::pow(0.09 / (1.49 - 1.4 * c), 2);
  };
  const double expected = density * power(447.0) * power(447.0) / power(223.0);
  EXPECT_NEAR(folded_acceleration_m2ps3(t_s, fallen, {}), expected, 0.25 * expected);
}

// Each part by itself, where the others are nothing.
TEST(HeightErrorDensity, HasItsPartsInTheirPlaces) {
  const double omega = 2.0 * std::numbers::pi * 5.0;
  HeightErrors errors;
  errors.accel_psd_m2ps3 = 1e-6;
  errors.tracker_psd_m2ps = 1e3;  // a tracker that says nothing
  const double white = 1e-6 / std::pow(omega, 4);
  EXPECT_NEAR(height_error_density_m2ps(errors, 5.0), white, 1e-6 * white);
  errors.accel_corner_Hz = 10.0;
  EXPECT_NEAR(height_error_density_m2ps(errors, 5.0), 3.0 * white, 3e-6 * white);
  errors.accel_corner_Hz = 0.0;
  errors.accel_walk_psd_m2ps5 = 1e-6 * omega * omega;
  EXPECT_NEAR(height_error_density_m2ps(errors, 5.0), 2.0 * white, 2e-6 * white);
  errors.accel_walk_psd_m2ps5 = 0.0;
  errors.rotation_tracker_psd_rad2ps = 1e3;
  errors.rotation_rate_psd_rad2ps3 = 1e-8;
  errors.lever_m = 0.1;
  EXPECT_NEAR(height_error_density_m2ps(errors, 5.0), white + 0.01 * 1e-8 / (omega * omega), 1e-5 * white);
  errors.lever_m = 0.0;
  errors.crosstalk_Hz = {4.0, 6.0};
  errors.crosstalk_m2ps = {1e-10, 3e-10};
  EXPECT_NEAR(height_error_density_m2ps(errors, 5.0), white + 2e-10, 1e-5 * (white + 2e-10));
  // An accelerometer that says nothing: the tracker's own two errors.
  HeightErrors tracked;
  tracked.accel_psd_m2ps3 = 1e9;
  tracked.tracker_psd_m2ps = 1e-9;
  tracked.tracker_slow_sigma_m = 1e-4;
  tracked.tracker_slow_time_s = 0.5;
  const double slow = 4.0 * 1e-8 * 0.5 / (1.0 + std::pow(0.5 * omega, 2));
  EXPECT_NEAR(height_error_density_m2ps(tracked, 5.0), 1e-9 + slow, 1e-5 * (1e-9 + slow));
}

// A rest of 2 s in the midst: the height drifts by then, and where the path goes on there is a step. Most of the noise
// is beside it.
TEST(TextureNoise, IsLargestWhereTheTipRested) {
  Profile profile = even_stretch();
  for (std::size_t i = 1596; i < 1604; ++i) profile.speed_mps[i] = 8.0 * kSpacing_m / 2.0;
  TextureNoiseConfig config;
  config.max_stop_s = 10.0;
  const TextureNoiseEstimate estimate =
      estimate_texture_noise(profile, errors_of(1e-5, 1e-8), kCutoff_cycles_per_mm, config);
  EXPECT_GT(estimate.texture_sigma_m[1600], 2.0 * estimate.texture_sigma_m[800]);
}

}  // namespace
}  // namespace asperity
