// The reconstruction filter on waves of one frequency, on steps and on constants.
#include "asperity/texture/low_pass_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

constexpr double kCutoff = 2.0;  // cycles/mm

Texture of(TextureModel model) {
  Texture texture;
  texture.model = std::move(model);
  return texture;
}

double height_m(const Texture& t, double x_mm, double y_mm) {
  return evaluate_height(t.model, 1e-3 * x_mm, 1e-3 * y_mm).height_m;
}

// An image of a wave of `cycles_per_mm` along x on a mean of 1 mm, 40 pixels a millimetre, 8 mm of it.
HeightMap wave_map(double cycles_per_mm, Border border) {
  HeightMap map{320, 64, 0.025, 0.025, 0.5e-3, 1.5e-3, 16, border, {}};
  for (std::size_t i = 0; i < 320 * 64; ++i) {
    const double x_mm = 0.025 * static_cast<double>(i % 320);
    const double h = 0.5 + 0.25 * std::cos(2.0 * std::numbers::pi * cycles_per_mm * x_mm);
    map.level.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * h)));
  }
  return map;
}

TEST(LowPassTexture, TakesAWaveByItsGain) {
  EXPECT_EQ(low_pass_gain(0.5 * kCutoff, kCutoff), 1.0);
  EXPECT_NEAR(low_pass_gain(0.75 * kCutoff, kCutoff), 0.5, 1e-15);
  EXPECT_EQ(low_pass_gain(kCutoff, kCutoff), 0.0);
  for (const double f : {0.5, 1.0, 1.25, 1.5, 1.75, 2.0, 4.0}) {
    const double gain = low_pass_gain(f, kCutoff);
    const auto harmonic = static_cast<std::size_t>(std::lround(8.0 * f));
    Fourier1d series{8.0, std::vector<double>(40, 0.0), std::vector<double>(40, 0.0), 1e-3};
    series.a_m[harmonic - 1] = 0.25e-3;
    const Texture line = low_pass_texture(of(series), kCutoff);
    const Texture tiling = low_pass_texture(of(wave_map(f, Border::kPeriodic)), kCutoff);
    const Texture mirrored = low_pass_texture(of(wave_map(f, Border::kMirror)), kCutoff);
    for (double x_mm = 0.0; x_mm < 7.9; x_mm += 0.025) {
      const double wanted_m = 1e-3 + gain * 0.25e-3 * std::cos(2.0 * std::numbers::pi * f * x_mm);
      EXPECT_NEAR(height_m(line, x_mm, 0.0), wanted_m, 1e-12);
      // Half a level of the source is 8 nm; what lies beyond the reach of 12 waves is below 1e-3 of the amplitude.
      EXPECT_NEAR(height_m(tiling, x_mm, 0.3), wanted_m, 2.5e-7) << f << ' ' << x_mm;
      if (x_mm > 2.0 && x_mm < 6.0) {
        EXPECT_NEAR(height_m(mirrored, x_mm, 0.3), wanted_m, 5e-7) << f << ' ' << x_mm;
      }
    }
  }
}

TEST(LowPassTexture, LeavesOutHarmonicsBeyondTheCutoff) {
  const Fourier1d series{10.0, std::vector<double>(128, 1e-6), std::vector<double>(128, 1e-6), 0.0};
  const auto filtered = std::get<Fourier1d>(low_pass_texture(of(series), kCutoff).model);
  EXPECT_EQ(filtered.a_m.size(), 19u);
}

TEST(LowPassTexture, OvershootsAStepByNoMoreThanStated) {
  HeightMap map{512, 8, 0.02, 0.02, 0.0, 1e-3, 8, Border::kClamp, {}};
  for (std::size_t i = 0; i < 512 * 8; ++i) map.level.push_back(i % 512 < 256 ? 0 : 255);
  const Texture step = low_pass_texture(of(map), kCutoff);
  double low_m = 1.0, high_m = -1.0;
  for (double x_mm = 0.1; x_mm < 10.0; x_mm += 0.01) {
    low_m = std::min(low_m, height_m(step, x_mm, 0.08));
    high_m = std::max(high_m, height_m(step, x_mm, 0.08));
  }
  EXPECT_LT(high_m, 1.08e-3);
  EXPECT_GT(low_m, -0.08e-3);
}

TEST(LowPassTexture, KeepsConstantsAndMeans) {
  HeightMap map{37, 11, 0.1, 0.1, 0.0, 1e-3, 8, Border::kPeriodic, std::vector<std::uint16_t>(37 * 11, 51)};
  EXPECT_NEAR(height_m(low_pass_texture(of(map), kCutoff), 1.23, 0.4), 0.2e-3, 1e-10);
  SplineGrid grid{16, 12, 1e-4, 1e-4, 0.0, 0.0, Border::kMirror, std::vector<double>(16 * 12, 3e-5)};
  const auto areal = low_pass_texture(of(ArealTexture{grid, {}}), kCutoff);
  EXPECT_NEAR(height_m(areal, 0.7, 0.6), 3e-5, 1e-15);
}

TEST(LowPassTexture, IsotropicSurfacesKeepTheirPhases) {
  Fourier2d f;
  f.kind = Fourier2dKind::kIsotropic;
  f.isotropic.power_m2.assign(32, 0.0);
  f.isotropic.power_m2[4] = 1e-12;  // 0.5 cycles/mm
  Fourier2d both = f;
  both.isotropic.power_m2[29] = 1e-12;  // 3 cycles/mm
  const Texture filtered = low_pass_texture(of(both), kCutoff);
  const Texture wanted = low_pass_texture(of(f), kCutoff);
  for (double x_mm = 0.0; x_mm < 10.0; x_mm += 0.37)
    EXPECT_NEAR(height_m(filtered, x_mm, 0.5 * x_mm), height_m(wanted, x_mm, 0.5 * x_mm), 1e-12);
}

TEST(LowPassTexture, RefusesACutoffThatIsNone) {
  const Texture texture = of(Fourier1d{10.0, {1e-6}, {0.0}, 0.0});
  for (const double cutoff : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(low_pass_texture(texture, cutoff), Error);
}

}  // namespace
}  // namespace asperity
