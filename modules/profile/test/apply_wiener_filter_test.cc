#include "asperity/profile/apply_wiener_filter.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/random.h"
#include "asperity/signal/statistics.h"

namespace asperity {
namespace {

constexpr double kSpacing_mm = 0.025;
constexpr double kSpacing_m = 1e-3 * kSpacing_mm;
constexpr double kBridge_m = 2e-3;
constexpr std::size_t kPoints = 3200;
const std::vector<double> kFrequency{0.02, 20.0};

// White noise of this RMS has the density 2 Δx σ².
std::vector<double> white_psd(double rms_m) { return std::vector<double>(2, 2.0 * kSpacing_mm * rms_m * rms_m); }

std::vector<double> noise(std::uint64_t seed, double rms_m) {
  Random random(seed);
  std::vector<double> out(kPoints);
  for (double& x : out) x = rms_m * random.normal();
  return out;
}

// x₊ = φ x + w: its density is known, and with it what the best linear filter leaves.
std::vector<double> autoregressive(std::uint64_t seed, double phi, double rms_m) {
  Random random(seed, 1);
  std::vector<double> out(kPoints);
  double x = rms_m * random.normal();
  for (double& value : out) {
    value = x;
    x = phi * x + rms_m * std::sqrt(1.0 - phi * phi) * random.normal();
  }
  return out;
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(WienerFilter, ComesNearTheBestThereIs) {
  constexpr double kPhi = 0.95, kSurface_m = 20e-6, kNoise_m = 20e-6;
  // ∫ S_h S_n/(S_h + S_n) over the frequencies of the sampled process.
  double best_m2 = 0.0;
  constexpr int kSteps = 20'000;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / kSteps;
    const double surface =
        kSurface_m * kSurface_m * (1.0 - kPhi * kPhi) / (1.0 - 2.0 * kPhi * std::cos(angle) + kPhi * kPhi);
    best_m2 += surface * kNoise_m * kNoise_m / (surface + kNoise_m * kNoise_m) / kSteps;
  }
  double error_m2 = 0.0, expected_m2 = 0.0, r = 0.0, expected_r = 0.0;
  constexpr int kSeeds = 10;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<double> truth = autoregressive(static_cast<std::uint64_t>(seed), kPhi, kSurface_m);
    std::vector<double> measured = noise(static_cast<std::uint64_t>(seed) + 100, kNoise_m);
    for (std::size_t i = 0; i < kPoints; ++i) measured[i] += truth[i];
    const WienerTexture out = apply_wiener_filter(measured, kSpacing_m, kFrequency, white_psd(kNoise_m), kBridge_m);
    error_m2 += std::pow(rms_difference(out.texture_m, truth), 2) / kSeeds;
    expected_m2 += out.error_rms_m * out.error_rms_m / kSeeds;
    r += correlation(out.texture_m, truth) / kSeeds;
    expected_r += out.expected_correlation / kSeeds;
    EXPECT_NEAR(out.error_ratio, out.error_rms_m / kNoise_m, 1e-3);
  }
  // The surface's density is estimated from nine bins: its own error costs at most a quarter of the power.
  EXPECT_LT(error_m2, 1.25 * best_m2);
  EXPECT_GT(error_m2, 0.9 * best_m2);
  EXPECT_NEAR(expected_m2, error_m2, 0.25 * error_m2);
  EXPECT_NEAR(expected_r, r, 0.03);
}

// An unknown angle times a known motion: nothing of it is taken off, its power is in the error, and the surface keeps
// its scale. The same density taken for noise shrinks the surface.
TEST(WienerFilter, KeepsWhatHasNoExpectedValue) {
  constexpr double kSurface_m = 20e-6, kNoise_m = 4e-6, kKept_m = 8e-6;
  const std::vector<double> noise_psd = white_psd(kNoise_m), kept_psd = white_psd(kKept_m);
  const std::vector<double> both_psd = white_psd(std::hypot(kNoise_m, kKept_m));
  double error_m2 = 0.0, expected_m2 = 0.0, gain = 0.0, shrunk_gain = 0.0;
  constexpr int kSeeds = 40;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<double> truth = autoregressive(seed, 0.95, kSurface_m);
    // The carried motion is one draw of the angle: its power differs from scan to scan.
    const double angle = Random(seed, 9).normal();
    const std::vector<double> sway = noise(seed + 300, kKept_m);
    std::vector<double> measured = noise(seed + 100, kNoise_m);
    for (std::size_t i = 0; i < kPoints; ++i) measured[i] += truth[i] + angle * sway[i];
    const WienerTexture out = apply_wiener_filter(measured, kSpacing_m, kFrequency, noise_psd, kBridge_m, kept_psd);
    const WienerTexture shrunk = apply_wiener_filter(measured, kSpacing_m, kFrequency, both_psd, kBridge_m);
    error_m2 += std::pow(rms_difference(out.texture_m, truth), 2) / kSeeds;
    expected_m2 += out.error_rms_m * out.error_rms_m / kSeeds;
    const double spread = rms(truth);
    gain += correlation(out.texture_m, truth) * rms(out.texture_m) / spread / kSeeds;
    shrunk_gain += correlation(shrunk.texture_m, truth) * rms(shrunk.texture_m) / spread / kSeeds;
    EXPECT_NEAR(out.error_ratio, out.error_rms_m / std::hypot(kNoise_m, kKept_m), 1e-3);
    EXPECT_LT(out.kept_rms_m, kKept_m);
    EXPECT_LE(out.kept_rms_m, out.error_rms_m * 1.001);
  }
  // Of the angle's square forty draws have a standard error of √(2/40), 22 %.
  EXPECT_NEAR(expected_m2, error_m2, 0.5 * error_m2);
  EXPECT_GT(gain, shrunk_gain + 0.03);
  EXPECT_NEAR(gain, 1.0, 0.05);
}

// At the angle's own standard deviation the kept error has the stated power, and the correlation is the expected one.
TEST(WienerFilter, ExpectsTheCorrelationThatTheKeptErrorLeaves) {
  constexpr double kNoise_m = 4e-6, kKept_m = 8e-6;
  double r = 0.0, expected_r = 0.0;
  constexpr int kSeeds = 10;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<double> truth = autoregressive(seed, 0.95, 20e-6), sway = noise(seed + 300, kKept_m);
    std::vector<double> measured = noise(seed + 100, kNoise_m);
    for (std::size_t i = 0; i < kPoints; ++i) measured[i] += truth[i] + sway[i];
    const WienerTexture out =
        apply_wiener_filter(measured, kSpacing_m, kFrequency, white_psd(kNoise_m), kBridge_m, white_psd(kKept_m));
    r += correlation(out.texture_m, truth) / kSeeds;
    expected_r += out.expected_correlation / kSeeds;
  }
  EXPECT_NEAR(expected_r, r, 0.03);
}

TEST(WienerFilter, WithNothingKeptIsTheSame) {
  const std::vector<double> measured = autoregressive(11, 0.9, 20e-6), none(kFrequency.size(), 0.0);
  const WienerTexture plain = apply_wiener_filter(measured, kSpacing_m, kFrequency, white_psd(5e-6), kBridge_m);
  const WienerTexture kept = apply_wiener_filter(measured, kSpacing_m, kFrequency, white_psd(5e-6), kBridge_m, none);
  EXPECT_EQ(plain.texture_m, kept.texture_m);
  EXPECT_EQ(plain.error_rms_m, kept.error_rms_m);
  EXPECT_EQ(kept.kept_rms_m, 0.0);
}

TEST(WienerFilter, TakesNoiseAloneAway) {
  const std::vector<double> measured = noise(7, 10e-6);
  const WienerTexture out = apply_wiener_filter(measured, kSpacing_m, kFrequency, white_psd(10e-6), kBridge_m);
  EXPECT_LT(rms(out.texture_m), 0.35 * 10e-6);
}

TEST(WienerFilter, LeavesWhatStandsOutAsItIs) {
  const std::vector<double> measured = autoregressive(3, 0.95, 20e-6);
  const WienerTexture out = apply_wiener_filter(measured, kSpacing_m, kFrequency, white_psd(1e-9), kBridge_m);
  EXPECT_LT(rms_difference(out.texture_m, measured), 1e-9);
  EXPECT_NEAR(out.expected_correlation, 1.0, 1e-6);
}

TEST(WienerFilter, GapsStayAndDoNotJoinRuns) {
  std::vector<double> measured = autoregressive(5, 0.9, 20e-6);
  for (std::size_t i = 1000; i < 1200; ++i) measured[i] = kNan;  // 5 mm
  for (std::size_t i = 2000; i < 2010; ++i) measured[i] = kNan;  // 0.25 mm
  const WienerTexture out = apply_wiener_filter(measured, kSpacing_m, kFrequency, white_psd(5e-6), kBridge_m);
  for (std::size_t i = 0; i < kPoints; ++i) EXPECT_EQ(std::isnan(out.texture_m[i]), std::isnan(measured[i])) << i;
  std::vector<double> first(measured.begin(), measured.begin() + 1000);
  const WienerTexture alone = apply_wiener_filter(first, kSpacing_m, kFrequency, white_psd(5e-6), kBridge_m);
  for (std::size_t i = 0; i < 1000; ++i) EXPECT_EQ(out.texture_m[i], alone.texture_m[i]) << i;
}

TEST(WienerFilter, RefusesSpectraThatDoNotFit) {
  const std::vector<double> measured(100, 0.0);
  EXPECT_THROW(apply_wiener_filter(measured, kSpacing_m, kFrequency, std::vector<double>(3, 0.0), kBridge_m), Error);
  EXPECT_THROW(apply_wiener_filter(measured, 0.0, kFrequency, white_psd(1e-6), kBridge_m), Error);
  EXPECT_THROW(apply_wiener_filter(measured, kSpacing_m, {}, {}, kBridge_m), Error);
  EXPECT_THROW(
      apply_wiener_filter(measured, kSpacing_m, kFrequency, white_psd(1e-6), kBridge_m, std::vector<double>(3, 0.0)),
      Error);
}

}  // namespace
}  // namespace asperity
