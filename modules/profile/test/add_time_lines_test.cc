#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/profile/find_time_lines.h"

namespace asperity {
namespace {

// A profile at 20 to 40 mm/s, and noise of 3 µm in a texture of 10 µm.
Profile profile_of() {
  Profile out;
  for (int i = 0; i < 2000; ++i) {
    out.s_m.push_back(i * out.spacing_m);
    out.speed_mps.push_back(0.03 + 0.01 * std::sin(0.01 * i));
    out.height_m.push_back(0.0);
    out.texture_m.push_back(0.0);
    out.sigma_m.push_back(4e-6);
    out.texture_sigma_m.push_back(3e-6);
  }
  return out;
}

TextureNoise noise_of() {
  TextureNoise out;
  for (double k = 0.1; k < 20.0; k *= 1.05) {
    out.frequency_cycles_per_mm.push_back(k);
    out.added_psd_m2_mm.push_back(1e-13);
  }
  out.added_sigma_m.assign(2000, 3e-6);
  out.added_rms_m = out.noise_rms_m = out.typical_added_rms_m = 3e-6;
  out.added_rms_stderr_m = out.noise_rms_stderr_m = 0.3e-6;
  out.typical_misplaced_rms_m = 0.0;
  out.texture_rms_m = out.typical_texture_rms_m = 10e-6;
  return out;
}

double integral(const TextureNoise& noise) {
  const std::vector<double>& k = noise.frequency_cycles_per_mm;
  double sum = 0.0;
  for (std::size_t i = 1; i < k.size(); ++i)
    sum += 0.5 * (k[i] - k[i - 1]) * (noise.added_psd_m2_mm[i] + noise.added_psd_m2_mm[i - 1]);
  return sum;
}

TEST(AddTimeLines, TheirPowerIsInTheDensityAtTheFrequenciesOfTheSpeeds) {
  Profile profile = profile_of();
  TextureNoise noise = noise_of();
  const double before_m2 = integral(noise);
  noise.time_lines = {{60.0, 0.3, 4e-6, false}, {50.0, 0.3, 9e-6, true}};
  add_time_lines(profile, noise);
  EXPECT_NEAR(integral(noise) - before_m2, 16e-12, 1e-3 * 16e-12);
  for (std::size_t i = 0; i < noise.added_psd_m2_mm.size(); ++i) {
    const double k = noise.frequency_cycles_per_mm[i];  // 1.5 to 3 cycles/mm, and a step of 5 % about them
    const double density = noise.added_psd_m2_mm[i];
    if (k < 1.4 || k > 3.2) {
      EXPECT_EQ(density, 1e-13) << k;
    } else if (k > 1.5 && k < 3.0) {
      EXPECT_GT(density, 2e-13) << k;
    }
  }
}

TEST(AddTimeLines, AreInAllThatIsSaidOfTheNoise) {
  Profile profile = profile_of();
  TextureNoise noise = noise_of();
  noise.time_lines = {{60.0, 0.3, 4e-6, false}};
  add_time_lines(profile, noise);
  EXPECT_NEAR(noise.noise_rms_m, 5e-6, 1e-12);  // √(3² + 4²)
  EXPECT_NEAR(noise.added_rms_m, 5e-6, 1e-12);
  EXPECT_NEAR(profile.texture_sigma_m[7], 5e-6, 1e-12);
  EXPECT_NEAR(profile.sigma_m[7], std::sqrt(32.0) * 1e-6, 1e-12);
  EXPECT_NEAR(noise.snr, 3.0, 1e-9);  // (100 − 25) / 25
  // The power is known to a fifth, as before.
  EXPECT_NEAR(noise.added_rms_stderr_m / noise.added_rms_m, 0.1, 1e-9);
  EXPECT_NEAR(noise.at_most_m, std::sqrt(100.0 - 25.0 * (1.0 - 1.96 * 0.2)) * 1e-6, 1e-11);
  EXPECT_LT(noise.snr_low, noise.snr);
}

// The noise before may have been made as large as the measured texture, hum and all: an upper bound of 0 would be
// wrong.
TEST(AddTimeLines, NoiseIsNoMoreThanWhatWasMeasured) {
  Profile profile = profile_of();
  TextureNoise noise = noise_of();
  noise.time_lines = {{60.0, 0.3, 9.9e-6, false}};
  add_time_lines(profile, noise);
  EXPECT_NEAR(noise.added_rms_m, 10e-6, 1e-12);
  EXPECT_EQ(noise.snr, 0.0);
  EXPECT_NEAR(noise.at_most_m, std::sqrt(1.96 * 0.2) * 10e-6, 1e-11);
}

TEST(AddTimeLines, NothingIsDoneWithoutNoiseOrLines) {
  Profile profile = profile_of();
  TextureNoise noise;
  noise.time_lines = {{60.0, 0.3, 4e-6, false}};
  add_time_lines(profile, noise);
  EXPECT_TRUE(std::isnan(noise.noise_rms_m));
  noise = noise_of();
  noise.time_lines = {{60.0, 0.3, 4e-6, true}};
  add_time_lines(profile, noise);
  EXPECT_EQ(noise.noise_rms_m, 3e-6);
  EXPECT_EQ(profile.sigma_m[0], 4e-6);
}

}  // namespace
}  // namespace asperity
