#include "asperity/texture/fit_fourier2d.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/signal/spectrum.h"
#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/evaluate_fourier2d.h"
#include "asperity/texture/synthesize_isotropic.h"

namespace asperity {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

// A stochastic profile whose power falls with frequency.
Fourier1d rough_profile(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Fourier1d f{10.0, {}, {}, 2e-6};
  for (std::size_t j = 1; j <= count; ++j) {
    const double amplitude = 10e-6 / (1.0 + std::pow(static_cast<double>(j) / 10.0, 2));
    const double phase = random.uniform(0.0, 2 * pi);
    f.a_m.push_back(amplitude * std::cos(phase));
    f.b_m.push_back(amplitude * std::sin(phase));
  }
  return f;
}

// Round holes every 2.5 mm in a flat surface.
Fourier1d holes() {
  Fourier1d f{10.0, std::vector<double>(16, 0.0), std::vector<double>(16, 0.0), -0.5e-3};
  f.a_m[3] = 0.6e-3;
  f.a_m[7] = -0.15e-3;
  return f;
}

double rms_m(const std::vector<double>& z) {
  double mean = 0.0;
  for (const double v : z) mean += v / static_cast<double>(z.size());
  double square = 0.0;
  for (const double v : z) square += (v - mean) * (v - mean);
  return std::sqrt(square / static_cast<double>(z.size()));
}

void expect_gradient(const Fourier2d& t, double scale) {
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(-0.02, 0.02);
    const double y = random.uniform(-0.02, 0.02);
    constexpr double kStep_m = 1e-7;
    const HeightAndGradient h = evaluate_height(t, x, y);
    const double dx =
        (evaluate_height(t, x + kStep_m, y).height_m - evaluate_height(t, x - kStep_m, y).height_m) / (2 * kStep_m);
    const double dy =
        (evaluate_height(t, x, y + kStep_m).height_m - evaluate_height(t, x, y - kStep_m).height_m) / (2 * kStep_m);
    EXPECT_NEAR(h.slope_x, dx, 1e-3 * scale);
    EXPECT_NEAR(h.slope_y, dy, 1e-3 * scale);
  }
}

TEST(Fourier2dOuter, HasTheProfilesRmsHeightAndPeaksForHoles) {
  FitFourier2dConfig config;
  config.kind = Fourier2dFitKind::kOuter;
  const Fourier1d f = holes();
  const Fourier2dFit fit = fit_fourier2d(f, f, config);
  std::vector<double> z;
  for (int i = 0; i < 200; ++i) {
    for (int k = 0; k < 200; ++k) z.push_back(evaluate_height(fit.texture, 5e-5 * i, 5e-5 * k).height_m);
  }
  EXPECT_NEAR(rms_m(z), fit.source_rms_m, 1e-9 * fit.source_rms_m);
  EXPECT_NEAR(fit.rms_height_m, fit.source_rms_m, 1e-12);
  // Where both profiles have a hole, the product of the zero-mean factors is a peak (erratum 21).
  EXPECT_GT(evaluate_height(fit.texture, 1.25e-3, 1.25e-3).height_m, f.mean_m);
  expect_gradient(fit.texture, 1.0);
}

TEST(Fourier2dPattern, IsTheProfileAlongItsDeepestLineAndTopBetween) {
  FitFourier2dConfig config;
  config.kind = Fourier2dFitKind::kPattern;
  const Fourier1d f = holes();
  const Fourier2dFit fit = fit_fourier2d(f, f, config);
  double deepest_m = 0.0;
  double lowest = 1.0;
  double highest = -1.0;
  for (int i = 0; i < 10000; ++i) {
    const double z = evaluate_height(f, 1e-6 * i).height_m;
    if (z < lowest) lowest = z, deepest_m = 1e-6 * i;
    highest = std::max(highest, z);
  }
  for (double x = 0.0; x < 0.01; x += 1.37e-4)
    EXPECT_NEAR(evaluate_height(fit.texture, x, deepest_m).height_m, evaluate_height(f, x).height_m, 1e-8) << x;
  EXPECT_NEAR(evaluate_height(fit.texture, deepest_m, deepest_m).height_m, lowest, 1e-8);
  for (double x = 0.0; x < 0.01; x += 1.37e-4) {
    for (double y = 0.0; y < 0.01; y += 1.37e-4) {
      EXPECT_LE(evaluate_height(fit.texture, x, y).height_m, highest + 1e-9);
      EXPECT_GE(evaluate_height(fit.texture, x, y).height_m + fit.height_offset_m, -1e-12);
    }
  }
  EXPECT_NEAR(fit.height_offset_m, -lowest, 1e-8);
}

TEST(SynthesizeIsotropic, IsTheSumOfItsWaves) {
  // One ring of radius 1: two waves of unknown phase in all, cos(ωx + φ) and cos(ωy + ψ), of power 2P each.
  const double power_m2 = 1e-12;
  const IsotropicSpectrum one{10.0, {power_m2, 0.0, 0.0, 0.0}, 5e-6, 4};
  Fourier2d t;
  t.kind = Fourier2dKind::kIsotropic;
  t.isotropic = one;
  t.grid = synthesize_isotropic(one);
  // ring 1 holds (1,0), (0,1) and (1,1) of radius 1.41: four waves.
  const auto mean_of = [&](auto f) {
    double sum = 0.0;
    for (int i = 0; i < 64; ++i) {
      for (int k = 0; k < 64; ++k) sum += f(0.01 * i / 64.0, 0.01 * k / 64.0);
    }
    return sum / 4096.0;
  };
  const auto height = [&](double x, double y) { return evaluate_height(t, x, y).height_m; };
  EXPECT_NEAR(mean_of(height), 5e-6, 1e-12);
  // A cubic spline through 16 points a wave misses the wave by less than a thousandth between them.
  EXPECT_NEAR(mean_of([&](double x, double y) { return std::pow(height(x, y) - 5e-6, 2); }), 8 * power_m2,
              8e-3 * power_m2);
  for (const std::pair<double, double>& wave : {std::pair{1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {1.0, -1.0}}) {
    const auto angle = [&](double x, double y) { return 200 * pi * (wave.first * x + wave.second * y); };
    const double c = mean_of([&](double x, double y) { return height(x, y) * std::cos(angle(x, y)); });
    const double s = mean_of([&](double x, double y) { return height(x, y) * std::sin(angle(x, y)); });
    EXPECT_NEAR(c * c + s * s, power_m2, 2e-3 * power_m2) << wave.first << "," << wave.second;
  }
}

TEST(Fourier2dIsotropic, SectionsInEveryDirectionHaveTheProfilesSpectrum) {
  const Fourier1d f = rough_profile(128, 1);
  const Fourier2dFit fit = fit_fourier2d(f, f);
  EXPECT_LT(fit.spectrum_error, 0.1);
  EXPECT_TRUE(fit.problems.empty());
  double power = 0.0;
  for (std::size_t j = 0; j < 128; ++j) power += 0.5 * (f.a_m[j] * f.a_m[j] + f.b_m[j] * f.b_m[j]);
  EXPECT_NEAR(fit.source_rms_m, std::sqrt(power), 1e-15);
  // Sections along x and y have the period; a diagonal one along (1, 1) has the period √2 L.
  const auto octave_power = [&](double direction_x, double direction_y, double length_m) {
    std::vector<double> octaves(7, 0.0);
    constexpr int kLines = 64;
    const auto count = static_cast<std::size_t>(std::lround(length_m / 0.02e-3));
    for (int line = 0; line < kLines; ++line) {
      const double offset = 0.01 * line / kLines;
      std::vector<double> z;
      for (std::size_t i = 0; i < count; ++i) {
        const double s = length_m * static_cast<double>(i) / static_cast<double>(count);
        z.push_back(
            evaluate_height(fit.texture, direction_x * s - direction_y * offset, direction_y * s + direction_x * offset)
                .height_m);
      }
      const auto dft = real_dft(z);
      for (std::size_t k = 1; k + 1 < dft.size(); ++k) {
        const double cycles_per_mm = static_cast<double>(k) / (length_m * 1e3);
        const auto octave = static_cast<int>(std::floor(std::log2(cycles_per_mm / 0.0999)));
        if (octave >= 0 && octave < 7)
          octaves[static_cast<std::size_t>(octave)] += 2.0 * std::norm(dft[k] / static_cast<double>(count)) / kLines;
      }
    }
    return octaves;
  };
  std::vector<double> wanted(7, 0.0);
  for (std::size_t j = 1; j <= 128; ++j) {
    const auto octave = static_cast<std::size_t>(std::floor(std::log2(0.1 * static_cast<double>(j) / 0.0999)));
    if (octave < 7) wanted[octave] += 0.5 * (f.a_m[j - 1] * f.a_m[j - 1] + f.b_m[j - 1] * f.b_m[j - 1]);
  }
  const double h = std::sqrt(0.5);
  for (const auto& [dx, dy, length_m] : {std::tuple{1.0, 0.0, 0.01}, {0.0, 1.0, 0.01}, {h, h, 0.01 * std::sqrt(2.0)}}) {
    const auto got = octave_power(dx, dy, length_m);
    double sum = 0.0;
    double wanted_sum = 0.0;
    for (std::size_t k = 0; k < 7; ++k) sum += got[k], wanted_sum += wanted[k];
    // 64 lines of one surface are few independent ones at the longest waves.
    EXPECT_NEAR(std::sqrt(sum / wanted_sum), 1.0, 0.08) << dx;
    for (std::size_t k = 2; k < 7; ++k) EXPECT_NEAR(std::sqrt(got[k] / wanted[k]), 1.0, 0.15) << dx << " octave " << k;
  }
  expect_gradient(fit.texture, 0.1);
}

TEST(Fourier2dIsotropic, SeedsDifferAndRepeat) {
  const Fourier1d f = rough_profile(32, 2);
  FitFourier2dConfig config;
  const Fourier2dFit a = fit_fourier2d(f, f, config);
  const Fourier2dFit b = fit_fourier2d(f, f, config);
  EXPECT_EQ(a.texture.grid.coefficient_m, b.texture.grid.coefficient_m);
  config.seed = 1;
  const Fourier2dFit c = fit_fourier2d(f, f, config);
  EXPECT_NE(a.texture.grid.coefficient_m, c.texture.grid.coefficient_m);
  EXPECT_NEAR(a.rms_height_m, c.rms_height_m, 1e-2 * a.rms_height_m);
}

TEST(Fourier2dIsotropic, SaysThatAPatternIsNone) {
  const Fourier1d f = holes();
  const Fourier2dFit fit = fit_fourier2d(f, f);
  EXPECT_GT(fit.spectrum_error, 0.2);
  ASSERT_EQ(fit.problems.size(), 1u);
  EXPECT_EQ(fit.problems[0].kind, "not_isotropic");
}

TEST(Fourier2d, APeriodicProfileIsAPatternByDefault) {
  const Fourier1d f = holes();
  EXPECT_EQ(fit_fourier2d(f, f, {}, true).texture.kind, Fourier2dKind::kPattern);
  EXPECT_EQ(fit_fourier2d(f, f, {}, false).texture.kind, Fourier2dKind::kIsotropic);
  EXPECT_EQ(fit_fourier2d(f, f, {.kind = Fourier2dFitKind::kIsotropic}, true).texture.kind, Fourier2dKind::kIsotropic);
}

TEST(Fourier2d, RefusesFlatProfiles) {
  const Fourier1d flat{10.0, {0.0}, {0.0}, 1e-6};
  EXPECT_THAT([&] { fit_fourier2d(flat, flat); }, ThrowsMessage<Error>(HasSubstr("flat")));
}

}  // namespace
}  // namespace asperity
