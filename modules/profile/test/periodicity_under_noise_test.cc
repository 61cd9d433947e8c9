#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "asperity/base/random.h"
#include "asperity/profile/find_periodicity_under_noise.h"
#include "draw_noise.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;
constexpr std::size_t kPoints = 3200;  // 80 mm

// Noise that falls with the fourth power of the frequency, as twice integrated acceleration does, from 0.1 cycles/mm.
TextureNoise make_noise(double rms_m) {
  TextureNoise noise;
  double power = 0.0;
  for (double k = 0.02; k < 20.0; k *= 1.06) {
    const double high_pass = 1.0 / (1.0 + 0.414 * std::pow(0.1 / k, 4.0));
    noise.frequency_cycles_per_mm.push_back(k);
    noise.added_psd_m2_mm.push_back(high_pass * high_pass / (1.0 + std::pow(k / 0.15, 4.0)));
    power += noise.added_psd_m2_mm.back() * 0.06 * k;
  }
  for (double& density : noise.added_psd_m2_mm) density *= rms_m * rms_m / power;
  noise.misplaced_psd_m2_mm.assign(noise.frequency_cycles_per_mm.size(), 0.0);
  noise.added_rms_m = noise.noise_rms_m = rms_m;
  noise.added_rms_stderr_m = noise.noise_rms_stderr_m = 0.1 * rms_m;
  return noise;
}

std::vector<double> disturbed(double amplitude_m, double pitch_m, const TextureNoise& noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> out =
      draw_noise(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, kPoints, 1e3 * kSpacing_m, random);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] += amplitude_m * std::sin(2.0 * std::numbers::pi * kSpacing_m * static_cast<double>(i) / pitch_m);
  return out;
}

TEST(PeriodicityUnderNoise, FindsAPatternBelowItsNoise) {
  const TextureNoise noise = make_noise(60e-6);
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Periodicity p = find_periodicity_under_noise(disturbed(40e-6, 1.3e-3, noise, seed), kSpacing_m, noise, {});
    if (!p.periodic) continue;
    ++found;
    EXPECT_NEAR(p.pitch_m, 1.3e-3, 5e-6) << seed;
  }
  EXPECT_GE(found, 18);
}

TEST(PeriodicityUnderNoise, FindsNoPitchInNoise) {
  const TextureNoise noise = make_noise(60e-6);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Periodicity p = find_periodicity_under_noise(disturbed(0.0, 1.3e-3, noise, seed), kSpacing_m, noise, {});
    EXPECT_FALSE(p.periodic) << seed << ": " << 1e3 * p.pitch_m << " mm";
    EXPECT_FALSE(std::isfinite(p.pitch_stderr_m)) << seed;
  }
}

// Two waves of one height, 2 and 1 mm long. The noise falls with the frequency: at the first it has 16 times the
// density that it has at the second, so the second stands out further. Its length is half the pitch. One wave alone
// keeps its own length.
TEST(PeriodicityUnderNoise, OfTwoEqualWavesTheLongerOneIsThePitch) {
  constexpr double kHeight_m = 16e-6;
  const TextureNoise noise = make_noise(60e-6);
  int right = 0, half = 0, alone = 0, twice = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const std::vector<double> short_m = disturbed(kHeight_m, 1e-3, noise, seed);
    std::vector<double> both_m = short_m;
    for (std::size_t i = 0; i < kPoints; ++i)
      both_m[i] += kHeight_m * std::cos(2.0 * std::numbers::pi * kSpacing_m * static_cast<double>(i) / 2e-3);
    const auto is_near = [](double pitch_m, double expected_m) { return std::abs(pitch_m / expected_m - 1.0) < 0.01; };
    const Periodicity of_both = find_periodicity_under_noise(both_m, kSpacing_m, noise, {});
    right += of_both.periodic && is_near(of_both.pitch_m, 2e-3) ? 1 : 0;
    half += of_both.periodic && is_near(of_both.pitch_m, 1e-3) ? 1 : 0;
    const Periodicity of_one = find_periodicity_under_noise(short_m, kSpacing_m, noise, {});
    alone += of_one.periodic && is_near(of_one.pitch_m, 1e-3) ? 1 : 0;
    twice += of_one.periodic && is_near(of_one.pitch_m, 2e-3) ? 1 : 0;
  }
  EXPECT_GE(right, 34);
  EXPECT_LE(half, 3);
  EXPECT_GE(alone, 38);
  EXPECT_LE(twice, 2);  // the first wave's ordinate may be noise in 1 %
}

// A hand's tremor at 25 mm/s: waves of 8 to 12 Hz, five times as high as the pattern, that are no noise.
std::vector<double> with_tremor(double amplitude_m, double pitch_m, const TextureNoise& noise, std::uint64_t seed) {
  std::vector<double> out = disturbed(amplitude_m, pitch_m, noise, seed);
  Random random(seed, 1);
  const std::vector<double> tremor = draw_noise(std::vector{0.32, 0.33, 0.47, 0.48}, std::vector{0.0, 1.0, 1.0, 0.0},
                                                kPoints, 1e3 * kSpacing_m, random);
  double power = 0.0;
  for (const double x : tremor) power += x * x / kPoints;
  for (std::size_t i = 0; i < kPoints; ++i) out[i] += 20e-6 / std::sqrt(power) * tremor[i];
  return out;
}

TEST(PeriodicityUnderNoise, TremorIsNoPattern) {
  const TextureNoise noise = make_noise(2e-6);
  int found = 0, right = 0, wrong = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Periodicity p = find_periodicity_under_noise(with_tremor(5.6e-6, 0.8e-3, noise, seed), kSpacing_m, noise, {});
    if (p.periodic) {
      ++found;
      right += std::abs(p.pitch_m - 0.8e-3) < 0.4e-6 ? 1 : 0;  // 0.05 %
    }
    wrong += find_periodicity_under_noise(with_tremor(0.0, 1e-3, noise, seed), kSpacing_m, noise, {}).periodic ? 1 : 0;
  }
  EXPECT_GE(found, 25);
  EXPECT_GE(right, found - 4);
  EXPECT_LE(wrong, 4);
}

// The autocorrelation of a pattern shorter than the shortest pitch peaks at twice its pitch, of which only every second
// harmonic is a line: no error, and no pitch is looked for below the limit.
TEST(PeriodicityUnderNoise, APatternBelowTheShortestPitchIsNoError) {
  const TextureNoise noise = make_noise(1e-6);
  const Periodicity p = find_periodicity_under_noise(disturbed(40e-6, 0.25e-3, noise, 1), kSpacing_m, noise, {});
  EXPECT_FALSE(p.periodic) << p.pitch_m;
}

TEST(PeriodicityUnderNoise, WithoutNoiseIsThePlainOne) {
  const std::vector<double> h = disturbed(40e-6, 1.3e-3, make_noise(1e-6), 3);
  const Periodicity plain = find_periodicity(h, kSpacing_m, {});
  const Periodicity same = find_periodicity_under_noise(h, kSpacing_m, {}, {});
  EXPECT_EQ(plain.pitch_m, same.pitch_m);
  EXPECT_EQ(plain.depth_stderr_m, same.depth_stderr_m);
}

}  // namespace
}  // namespace asperity
