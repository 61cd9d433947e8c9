#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "asperity/profile/measure_surface_spectrum.h"
#include "draw_noise.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;
constexpr std::size_t kPoints = 4000;  // 100 mm: six segments of 25.6 mm and more
constexpr double kPole = 0.9, kStep_m = 2e-6;

// One-sided, of x_k = a x_(k−1) + e_k: 2 σ² Δ / |1 − a exp(−iω)|².
double autoregressive_density_m2_mm(double cycles_per_mm) {
  const double angle = 2.0 * std::numbers::pi * cycles_per_mm * 1e3 * kSpacing_m;
  return 2e3 * kSpacing_m * kStep_m * kStep_m / std::norm(1.0 - std::polar(kPole, -angle));
}

std::vector<double> autoregressive(Random& random) {
  std::vector<double> out(kPoints);
  double x = kStep_m / std::sqrt(1.0 - kPole * kPole) * random.normal();
  for (double& value : out) value = x = kPole * x + kStep_m * random.normal();
  return out;
}

// Noise that falls with the frequency, of which the power is stated as `rms_m` squared, known to `relative`.
TextureNoise falling_noise(double rms_m, double relative) {
  TextureNoise noise;
  double power = 0.0;
  for (double k = 0.05; k < 20.0; k *= 1.05) {
    noise.frequency_cycles_per_mm.push_back(k);
    noise.added_psd_m2_mm.push_back(1.0 / (1.0 + std::pow(k / 0.4, 4.0)));
    power += noise.added_psd_m2_mm.back() * 0.05 * k;
  }
  for (double& density : noise.added_psd_m2_mm) density *= rms_m * rms_m / power;
  noise.misplaced_psd_m2_mm.assign(noise.frequency_cycles_per_mm.size(), 0.0);
  noise.added_rms_m = rms_m;
  noise.added_rms_stderr_m = 0.5 * relative * rms_m;
  return noise;
}

struct Held {
  double all = 0.0, noisy = 0.0, count = 0.0, noisy_count = 0.0;
};

// Of frequencies from 0.1 to 10 cycles/mm: how many intervals hold the process, in all and where there is more noise
// than surface. The noise's true level differs from the stated one by its own error.
Held hold(double rms_m, double relative) {
  Held out;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    std::vector<double> height_m = autoregressive(random);
    const TextureNoise noise = falling_noise(rms_m, relative);
    const double level = std::exp(std::sqrt(std::log1p(relative * relative)) * random.normal());
    const std::vector<double> more =
        draw_noise(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, kPoints, 1e3 * kSpacing_m, random);
    for (std::size_t i = 0; i < kPoints; ++i) height_m[i] += std::sqrt(level) * more[i];
    const SurfaceSpectrum s = measure_surface_spectrum(height_m, kSpacing_m, noise);
    for (std::size_t k = 0; k < s.size(); ++k) {
      const double f = s.frequency_cycles_per_mm[k];
      if (f < 0.1 || f > 10.0) continue;
      const double truth = autoregressive_density_m2_mm(f);
      const double holds = s.low_m2_mm[k] <= truth && truth <= s.high_m2_mm[k] ? 1.0 : 0.0;
      out.all += holds;
      out.count += 1.0;
      if (s.noise_m2_mm[k] < truth) continue;
      out.noisy += holds;
      out.noisy_count += 1.0;
    }
  }
  return out;
}

TEST(SurfaceSpectrum, ItsIntervalsHoldAnAutoregressiveProcess) {
  const Held quiet = hold(0.1e-6, 0.1);
  EXPECT_NEAR(quiet.all / quiet.count, 0.95, 0.01);
  const Held noisy = hold(40e-6, 0.3);
  EXPECT_GT(noisy.noisy_count, 300.0);
  EXPECT_NEAR(noisy.all / noisy.count, 0.95, 0.015);
  EXPECT_GT(noisy.noisy / noisy.noisy_count, 0.92);
}

TEST(SurfaceSpectrum, TheNoiseIsTakenOff) {
  double with = 0.0, without = 0.0, truth = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    std::vector<double> height_m = autoregressive(random);
    const TextureNoise noise = falling_noise(4e-6, 0.05);
    const std::vector<double> more =
        draw_noise(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, kPoints, 1e3 * kSpacing_m, random);
    for (std::size_t i = 0; i < kPoints; ++i) height_m[i] += more[i];
    const SurfaceSpectrum s = measure_surface_spectrum(height_m, kSpacing_m, noise);
    for (std::size_t k = 0; k < s.size(); ++k) {
      if (s.frequency_cycles_per_mm[k] < 0.2 || s.frequency_cycles_per_mm[k] > 0.6) continue;
      without += s.density_m2_mm[k];
      with += s.density_m2_mm[k] + s.noise_m2_mm[k];
      truth += autoregressive_density_m2_mm(s.frequency_cycles_per_mm[k]);
    }
  }
  EXPECT_GT(with, 1.15 * truth);
  EXPECT_NEAR(without, truth, 0.06 * truth);
}

TEST(SurfaceSpectrum, WithoutAKnownNoiseHasNoInterval) {
  Random random(1);
  const std::vector<double> height_m = autoregressive(random);
  const SurfaceSpectrum s = measure_surface_spectrum(height_m, kSpacing_m, {});
  EXPECT_EQ(s.density_m2_mm, measure_spectrum(height_m, kSpacing_m).density);
  EXPECT_TRUE(std::isnan(s.low_m2_mm.at(5)) && std::isnan(s.high_m2_mm.at(5)) && std::isnan(s.noise_m2_mm.at(5)));
  EXPECT_GT(s.freedom, 1.8 * static_cast<double>(s.segments));
  EXPECT_EQ(measure_surface_spectrum(std::vector<double>(5, 1e-6), kSpacing_m, {}).size(), 0U);
}

}  // namespace
}  // namespace asperity
