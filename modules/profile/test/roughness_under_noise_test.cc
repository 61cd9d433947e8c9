#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/nan.h"
#include "asperity/base/random.h"
#include "asperity/profile/estimate_texture_noise.h"
#include "asperity/profile/find_periodicity_under_noise.h"
#include "asperity/profile/measure_roughness_under_noise.h"
#include "draw_noise.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;
constexpr std::size_t kPoints = 3200;

// White noise between 0.5 and 8 cycles/mm with an RMS of `rms_m`.
TextureNoise band_noise(double rms_m) {
  TextureNoise noise;
  noise.frequency_cycles_per_mm = {0.5, 8.0};
  const double density = rms_m * rms_m / 7.5;
  noise.added_psd_m2_mm = {density, density};
  noise.misplaced_psd_m2_mm = {0.0, 0.0};
  noise.added_rms_m = noise.noise_rms_m = rms_m;
  noise.added_rms_stderr_m = 0.05 * rms_m;
  noise.snr = noise.snr_low = noise.measured_snr_low = 10.0;
  return noise;
}

std::vector<double> drawn(const TextureNoise& noise, std::uint64_t seed) {
  Random random(seed);
  return draw_noise(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, kPoints, 1e3 * kSpacing_m, random);
}

std::vector<double> sine(double amplitude_m, double pitch_m) {
  std::vector<double> out(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    out[i] = amplitude_m * std::sin(2.0 * std::numbers::pi * kSpacing_m * static_cast<double>(i) / pitch_m);
  }
  return out;
}

TEST(DrawNoise, HasThePowerOfItsDensity) {
  double power_m2 = 0.0;
  constexpr int kDrawn = 20;
  for (int seed = 0; seed < kDrawn; ++seed) {
    for (const double x : drawn(band_noise(3e-6), static_cast<std::uint64_t>(seed))) power_m2 += x * x;
  }
  // 1200 independent numbers a draw: 0.6 % of the power in all.
  EXPECT_NEAR(power_m2 / kDrawn / kPoints, 9e-12, 0.03 * 9e-12);
}

// A sine of known parameters under noise of a known spectrum, many times: the values are those of the sine, and its 95
// % intervals hold them.
TEST(RoughnessUnderNoise, GivesTheParametersWithoutTheNoise) {
  const std::vector<double> clean = sine(40e-6, 2e-3);
  const RoughnessResult truth = measure_roughness(clean, kSpacing_m);
  constexpr int kScans = 30;
  int held_Rq = 0, held_Ra = 0, held_Rku = 0;
  double Rq = 0.0, plain_Rq = 0.0;
  for (int seed = 1; seed <= kScans; ++seed) {
    const TextureNoise noise = band_noise(10e-6);
    std::vector<double> noisy = clean;
    const std::vector<double> more = drawn(noise, static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < kPoints; ++i) noisy[i] += more[i];
    const RoughnessResult r = measure_roughness_under_noise(noisy, kSpacing_m, noise);
    Rq += r.Rq_m / kScans;
    plain_Rq += measure_roughness(noisy, kSpacing_m).Rq_m / kScans;
    held_Rq += std::abs(r.Rq_m - truth.Rq_m) < 1.96 * r.standard_error.Rq_m ? 1 : 0;
    held_Ra += std::abs(r.Ra_m - truth.Ra_m) < 1.96 * r.standard_error.Ra_m ? 1 : 0;
    held_Rku += std::abs(r.Rku - truth.Rku) < 1.96 * r.standard_error.Rku ? 1 : 0;
    EXPECT_LT(r.standard_error.Rq_m, 0.05 * truth.Rq_m);
  }
  EXPECT_GT(plain_Rq, 1.04 * truth.Rq_m);           // √(1 + (10/28.3)²) − 1 = 6 %
  EXPECT_NEAR(Rq, truth.Rq_m, 0.005 * truth.Rq_m);  // 30 scans of 1 % each
  EXPECT_GE(held_Rq, 26);                           // 28.5 ± 1.2 of 30 are expected
  EXPECT_GE(held_Ra, 26);
  EXPECT_GE(held_Rku, 25);
}

// Noise as large as the surface, its power off by as much as is stated, and a surface without any height.
TEST(RoughnessUnderNoise, HoldsWhereNothingStandsOut) {
  constexpr int kScans = 40;
  constexpr double kRelative = 0.3;  // of the noise's power
  for (const double amplitude_m : {14e-6, 0.0}) {
    const std::vector<double> clean = sine(amplitude_m, 2e-3);
    const double truth = amplitude_m / std::numbers::sqrt2;
    const double true_Rku = measure_roughness(clean, kSpacing_m).Rku;
    int held = 0, holds_nothing = 0, with_Rku = 0, held_Rku = 0;
    for (int seed = 1; seed <= kScans; ++seed) {
      TextureNoise noise = band_noise(10e-6);
      noise.added_rms_stderr_m = 0.5 * kRelative * noise.added_rms_m;
      noise.snr = noise.snr_low = noise.measured_snr_low = 0.0;
      Random random(static_cast<std::uint64_t>(seed), 7);
      const double level = std::max(0.0, 1.0 + kRelative * random.normal());
      std::vector<double> noisy = drawn(noise, static_cast<std::uint64_t>(seed));
      for (std::size_t i = 0; i < kPoints; ++i) noisy[i] = std::sqrt(level) * noisy[i] + clean[i];
      const RoughnessResult r = measure_roughness_under_noise(noisy, kSpacing_m, noise);
      held += std::abs(r.Rq_m - truth) < 1.96 * r.standard_error.Rq_m ? 1 : 0;
      holds_nothing += r.Rq_m < 1.96 * r.standard_error.Rq_m ? 1 : 0;
      EXPECT_TRUE(std::isnan(r.RSm_m) && std::isnan(r.standard_error.RSm_m));
      EXPECT_EQ(std::isnan(r.Rku), std::isnan(r.standard_error.Rku));
      with_Rku += std::isnan(r.Rku) ? 0 : 1;
      held_Rku += std::abs(r.Rku - true_Rku) < 1.96 * r.standard_error.Rku ? 1 : 0;
    }
    if (amplitude_m > 0.0) {
      EXPECT_GE(with_Rku, 20);               // a power of 0.98 ± 0.3 of the noise's: above two of them in most
      EXPECT_GE(held_Rku, 0.85 * with_Rku);  // at 95 %, 0.85 of 20 to 40 has less than some percents
    } else {
      EXPECT_LE(with_Rku, 4);  // above two standard errors by chance: 2.5 %
    }
    EXPECT_GE(held, 36) << amplitude_m;
    if (amplitude_m == 0.0) {
      EXPECT_GE(holds_nothing, 34);
    }
  }
}

// A surface of deep grooves, whose kurtosis and skewness noise of the same power brings near those of a Gaussian.
TEST(RoughnessUnderNoise, ShapeIsThatOfTheSurfaceInStrongNoise) {
  std::vector<double> clean(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double u = std::cos(std::numbers::pi * kSpacing_m * static_cast<double>(i) / 0.9e-3);
    clean[i] = -25e-6 * std::pow(u * u, 4.0);
  }
  const RoughnessResult truth = measure_roughness(clean, kSpacing_m);
  constexpr int kScans = 40;
  int held_Rku = 0, held_Rsk = 0;
  double Rku = 0.0, Rsk = 0.0, plain_Rku = 0.0, spread = 0.0, stated = 0.0;
  for (int seed = 1; seed <= kScans; ++seed) {
    const TextureNoise noise = band_noise(truth.Rq_m);
    std::vector<double> noisy = drawn(noise, static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < kPoints; ++i) noisy[i] += clean[i];
    const RoughnessResult r = measure_roughness_under_noise(noisy, kSpacing_m, noise);
    Rku += r.Rku / kScans;
    Rsk += r.Rsk / kScans;
    plain_Rku += measure_roughness(noisy, kSpacing_m).Rku / kScans;
    spread += std::pow(r.Rku - truth.Rku, 2.0) / kScans;
    stated += std::pow(r.standard_error.Rku, 2.0) / kScans;
    held_Rku += std::abs(r.Rku - truth.Rku) < 1.96 * r.standard_error.Rku ? 1 : 0;
    held_Rsk += std::abs(r.Rsk - truth.Rsk) < 1.96 * r.standard_error.Rsk ? 1 : 0;
  }
  // The mean of 40 has a sixth of a scan's spread; three of these.
  EXPECT_NEAR(Rku, truth.Rku, 0.5 * std::sqrt(spread) + 0.1);
  EXPECT_NEAR(Rsk, truth.Rsk, 0.2);
  EXPECT_GT(std::abs(plain_Rku - truth.Rku), 3.0 * std::abs(Rku - truth.Rku));
  EXPECT_GE(held_Rku, 35);  // 38 ± 1.4 at 95 %
  EXPECT_GE(held_Rsk, 35);
  EXPECT_LT(stated, 9.0 * spread);
}

// Noise that goes with the surface or against it is not squared away: an amplitude's share is a height's share.
TEST(RoughnessUnderNoise, NoiseOfTheContactIsInTheError) {
  TextureNoise noise = band_noise(4e-6);
  const std::vector<double> clean = sine(40e-6, 2e-3);
  const RoughnessResult apart = measure_roughness_under_noise(clean, kSpacing_m, noise);
  noise.contact_rms_m = noise.added_rms_m;
  const RoughnessResult with = measure_roughness_under_noise(clean, kSpacing_m, noise);
  EXPECT_NEAR(with.standard_error.Rq_m, std::hypot(apart.standard_error.Rq_m, 4e-6 / std::numbers::sqrt3), 0.1e-6);
  noise.stretch_sigma = 0.1;
  EXPECT_NEAR(measure_roughness_under_noise(clean, kSpacing_m, noise).standard_error.Rq_m,
              std::hypot(with.standard_error.Rq_m, 0.05 * with.Rq_m), 0.15e-6);
}

// Low elements count by a tenth of Rz. Where the highest points are too high by what is stated of their scale, the low
// ones do not: the interval of RSm has to know.
TEST(RoughnessUnderNoise, WhichElementsCountIsInTheErrorOfRSm) {
  const auto high_and_low = [](double high_m) {
    std::vector<double> out = sine(21e-6, 2e-3);
    for (std::size_t i = 0; i < out.size(); ++i) {
      if ((i / 80) % 2 == 0) out[i] *= high_m / 21e-6;
    }
    return out;
  };
  const double truth_m = measure_roughness(high_and_low(100e-6), kSpacing_m).RSm_m;
  EXPECT_NEAR(truth_m, 2e-3, 0.02e-3);
  TextureNoise noise = band_noise(0.1e-6);
  noise.scale_sigma = 0.1;
  const RoughnessResult r = measure_roughness_under_noise(high_and_low(110e-6), kSpacing_m, noise);
  EXPECT_GT(r.RSm_m, 3e-3);
  EXPECT_LT(r.RSm_m - 1.96 * r.standard_error.RSm_m, truth_m);
}

// Long waves of noise, of which λc leaves a hundredth: by waves with random phases, of which the code knows the
// spectrum alone.
TEST(RoughnessUnderNoise, FiltersTakeTheirPartOfTheNoise) {
  const std::vector<double> clean = sine(10e-6, 0.2e-3);
  RoughnessConfig config;
  config.lambda_c_mm = 0.8;
  const RoughnessResult truth = measure_roughness(clean, kSpacing_m, config);
  constexpr double kRms_m = 20e-6;
  const TextureNoise noise = noise_of_sigma(clean, std::vector<double>(kPoints, kRms_m), kSpacing_m, 0.1);
  Random random(11);
  int holds = 0;
  constexpr int kScans = 20;
  for (int scan = 0; scan < kScans; ++scan) {
    // Waves with random phases, as many between two points of the stated density.
    std::vector<double> noisy = clean;
    const std::vector<double>& at = noise.frequency_cycles_per_mm;
    for (std::size_t j = 1; j < at.size(); ++j) {
      constexpr int kWaves = 4;
      const double power_m2 = 0.5 * (noise.added_psd_m2_mm[j] + noise.added_psd_m2_mm[j - 1]) * (at[j] - at[j - 1]);
      for (int wave = 0; wave < kWaves; ++wave) {
        const double k_per_m = 1e3 * random.uniform(at[j - 1], at[j]), phase = random.uniform(0.0, 6.2832);
        for (std::size_t i = 0; i < kPoints; ++i) {
          noisy[i] += std::sqrt(2.0 * power_m2 / kWaves) *
                      std::cos(2.0 * std::numbers::pi * k_per_m * kSpacing_m * static_cast<double>(i) + phase);
        }
      }
    }
    const RoughnessResult r = measure_roughness_under_noise(noisy, kSpacing_m, noise, config);
    ASSERT_TRUE(std::isfinite(r.Rq_m));
    EXPECT_LT(r.standard_error.Rq_m, 0.3e-6) << "of the whole noise it would be 20 µm";
    EXPECT_LT(r.standard_error.Rku, 0.2);
    holds += std::abs(r.Rq_m - truth.Rq_m) < 1.96 * r.standard_error.Rq_m &&
             std::abs(r.Rku - truth.Rku) < 1.96 * r.standard_error.Rku;
  }
  EXPECT_GE(holds, kScans - 3);
}

TEST(RoughnessUnderNoise, WithoutANoiseIsThePlainOne) {
  const std::vector<double> clean = sine(40e-6, 2e-3);
  const RoughnessResult r = measure_roughness_under_noise(clean, kSpacing_m, {});
  EXPECT_EQ(r.Rz_m, measure_roughness(clean, kSpacing_m).Rz_m);
  EXPECT_TRUE(std::isnan(r.standard_error.Rz_m));
}

// Noise of 5 µm adds some 17 µm to the highest less the lowest point of a period.
TEST(PeriodicityUnderNoise, TakesTheNoiseOffTheDepth) {
  const TextureNoise noise = band_noise(5e-6);
  std::vector<double> noisy = sine(40e-6, 2e-3);
  const std::vector<double> more = drawn(noise, 5);
  for (std::size_t i = 0; i < kPoints; ++i) noisy[i] += more[i];
  const Periodicity plain = find_periodicity(noisy, kSpacing_m, {});
  const Periodicity p = find_periodicity_under_noise(noisy, kSpacing_m, noise, {});
  EXPECT_GT(plain.depth_m, 88e-6);
  EXPECT_NEAR(p.depth_m, 80e-6, 3.0 * p.depth_stderr_m);
  EXPECT_LT(p.depth_stderr_m, 6e-6);
  EXPECT_NEAR(p.pitch_m, 2e-3, 4.0 * p.pitch_stderr_m);
}

TEST(NoiseOfSigma, HasThePowerOfTheSigmas) {
  std::vector<double> texture_m = sine(40e-6, 2e-3), sigma_m(kPoints, 6e-6);
  texture_m[7] = sigma_m[7] = kNan;
  const TextureNoise noise = noise_of_sigma(texture_m, sigma_m, kSpacing_m, 0.1);
  EXPECT_NEAR(noise.added_rms_m, 6e-6, 1e-12);
  EXPECT_NEAR(noise.snr, (40.0 * 40.0 / 2.0 - 36.0) / 36.0, 0.05);
  EXPECT_TRUE(noise_of_sigma(texture_m, {}, kSpacing_m, 0.1).added_psd_m2_mm.empty());
}

}  // namespace
}  // namespace asperity
