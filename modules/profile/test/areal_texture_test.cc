#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "areal_gaussian_filter.h"
#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/random.h"
#include "asperity/profile/measure_areal_texture.h"

namespace asperity {
namespace {

using std::numbers::pi;

template <class Height>
ArealMap map_of(std::size_t columns, std::size_t rows, double x_spacing_m, double y_spacing_m, const Height& height_m) {
  ArealMap map{x_spacing_m, y_spacing_m, columns, rows, {}};
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      map.height_m.push_back(
          height_m((static_cast<double>(column) + 0.5) * x_spacing_m, (static_cast<double>(row) + 0.5) * y_spacing_m));
    }
  }
  return map;
}

constexpr double kA_m = 2e-6, kPitch_m = 50e-6;

// cos + cos, whole periods: slopes and autocorrelation are those of cosines.
TEST(ArealTexture, OfAnEggBox) {
  const double k = 2 * pi / kPitch_m;
  const ArealMap map = map_of(400, 200, 1e-6, 2e-6, [&](double x, double y) {
    return 0.5 * kA_m * (std::cos(k * x) + std::cos(k * y)) + 1e-3 + 0.01 * x - 0.02 * y;
  });
  const ArealTextureResult r = measure_areal_texture(map);
  EXPECT_NEAR(r.slope_x, 0.01, 1e-6);
  EXPECT_NEAR(r.slope_y, -0.02, 1e-6);
  EXPECT_NEAR(r.Sq_m, kA_m / 2, 1e-4 * kA_m);
  EXPECT_NEAR(r.Sku, 2.25, 1e-3);
  EXPECT_NEAR(r.Sp_m, kA_m, 1e-2 * kA_m);
  // Slopes A k / 2 sin: root mean square of both together A k / 2. Ends are of second order and first: 1 %.
  EXPECT_NEAR(r.Sdq, 0.5 * kA_m * k, 0.01 * kA_m * k);
  double larger = 0.0;
  for (int i = 0; i < 400; ++i) {
    for (int j = 0; j < 400; ++j) {
      const double a = 0.5 * kA_m * k * std::sin(pi * i / 200), b = 0.5 * kA_m * k * std::sin(pi * j / 200);
      larger += (std::sqrt(1 + a * a + b * b) - 1) / 160000;
    }
  }
  EXPECT_NEAR(r.Sdr, larger, 0.02 * larger);
  // (cos k s + cos k t)/2 = 0.2: on the diagonal first, along the axes last.
  EXPECT_NEAR(r.Sal_m, std::numbers::sqrt2 * std::acos(0.2) / k, 0.01 * kPitch_m);
  EXPECT_NEAR(r.Str, std::numbers::sqrt2 * std::acos(0.2) / std::acos(-0.6), 0.02);
  EXPECT_TRUE(std::isnan(r.Std_rad)) << "an egg box has no lay";
}

TEST(ArealTexture, ALayHasItsDirection) {
  for (const double lay_deg : {0.0, 30.0, 60.0, 90.0, 143.7}) {
    const double lay = lay_deg * pi / 180;
    const ArealMap map = map_of(256, 200, 1e-6, 1e-6, [&](double x, double y) {
      return kA_m * std::sin(2 * pi * (y * std::cos(lay) - x * std::sin(lay)) / 13e-6);
    });
    const ArealTextureResult r = measure_areal_texture(map);
    const double off = std::remainder(r.Std_rad - lay, pi);
    // A cell of the spectrum is 1/200 µm wide and 1/13 µm away: 13/200 = 3.7°. The direction is found to a tenth of it.
    EXPECT_NEAR(off, 0.0, 0.1 * 13.0 / 200.0) << lay_deg;
    EXPECT_TRUE(std::isnan(r.Str)) << "along its lay it does not end within the map";
    EXPECT_NEAR(r.Sal_m, 13e-6 * std::acos(0.2) / (2 * pi), 0.2e-6) << lay_deg;
  }
}

// Independent heights: a box's curve is a straight line; volumes and core by its integral.
TEST(ArealTexture, TheMaterialCurveOfUniformHeights) {
  Random random(5);
  const ArealMap map = map_of(300, 300, 1e-6, 1e-6, [&](double, double) { return kA_m * random.uniform(); });
  const ArealTextureResult r = measure_areal_texture(map, {.form = ArealForm::kMean});
  // Quantiles of 90,000 heights scatter by 0.17 % of the range at most.
  EXPECT_NEAR(r.Sk_m, kA_m, 0.01 * kA_m);
  EXPECT_LT(r.Spk_m, 0.01 * kA_m);
  EXPECT_LT(r.Svk_m, 0.01 * kA_m);
  EXPECT_NEAR(r.Sxp_m, 0.475 * kA_m, 0.005 * kA_m);
  EXPECT_NEAR(r.Vmp_m, 0.01 / 2 * kA_m, 1e-3 * kA_m);
  EXPECT_NEAR(r.Vmc_m, (0.64 - 0.01) / 2 * kA_m, 3e-3 * kA_m);
  EXPECT_NEAR(r.Vvv_m, 0.04 / 2 * kA_m, 1e-3 * kA_m);
  EXPECT_NEAR(r.Vvc_m, (0.81 - 0.04) / 2 * kA_m, 3e-3 * kA_m);
}

TEST(ArealTexture, TheQuadricIsRemoved) {
  const ArealMap map =
      map_of(60, 50, 1e-6, 1e-6, [](double x, double y) { return 3 * x * x - 2 * x * y + y * y + 0.1 * x; });
  EXPECT_LT(measure_areal_texture(map, {.form = ArealForm::kQuadric}).Sq_m, 1e-18);
  EXPECT_GT(measure_areal_texture(map).Sq_m, 1e-11);
  EXPECT_THROW(measure_areal_texture(map_of(1, 50, 1e-6, 1e-6, [](double, double) { return 0.0; })), Error);
}

// Against the definition, summed directly: with gaps, and with a reach that is done by Fourier transforms.
TEST(ArealGaussian, AgreesWithTheDefinitionAndKeepsPlanes) {
  Random random(9);
  ArealMap map = map_of(150, 90, 1e-6, 1.5e-6, [&](double, double) { return random.normal(); });
  const ArealMap plane = map_of(150, 90, 1e-6, 1.5e-6, [](double x, double y) { return 1.0 + 2e4 * x - 3e4 * y; });
  for (const double cutoff_m : {20e-6, 80e-6}) {
    const ArealMap smooth = gaussian_mean_surface(map, cutoff_m);
    const double alpha2 = std::numbers::ln2 / pi;
    for (const auto& [column, row] : {std::pair<int, int>{75, 45}, {90, 40}}) {
      double sum = 0.0, weights = 0.0;
      for (int r = 0; r < 90; ++r) {
        for (int c = 0; c < 150; ++c) {
          const double x = 1e-6 * (c - column) / cutoff_m, y = 1.5e-6 * (r - row) / cutoff_m;
          if (std::abs(x) > 1.0001 || std::abs(y) > 1.0001) continue;
          const double w = std::exp(-pi * (x * x + y * y) / alpha2);
          sum += w * map.at(static_cast<std::size_t>(r), static_cast<std::size_t>(c));
          weights += w;
        }
      }
      // Where the window is whole the plane's value is the mean; of 80 µm the map cuts some, by weights under 1 %.
      const double value = smooth.at(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
      EXPECT_NEAR(value, sum / weights, cutoff_m < 50e-6 ? 1e-5 : 0.02);
    }
    ArealMap holes = plane;
    for (std::size_t i = 0; i < holes.height_m.size(); ++i) {
      if (i * 7919 % 5 == 0 || (i % 150 > 60 && i % 150 < 75)) holes.height_m[i] = kNan;
    }
    const ArealMap kept = gaussian_mean_surface(holes, cutoff_m);
    for (std::size_t i = 0; i < kept.height_m.size(); ++i) {
      if (std::isnan(holes.height_m[i])) {
        EXPECT_TRUE(std::isnan(kept.height_m[i]));
      } else {
        EXPECT_NEAR(kept.height_m[i], plane.height_m[i], 1e-9);
      }
    }
  }
  // A wave of the cut-off length in a slanted direction is halved.
  const double k = 2 * pi / 20e-6;
  const ArealMap wave =
      map_of(200, 200, 1e-6, 1e-6, [&](double x, double y) { return std::cos(k * (0.6 * x + 0.8 * y)); });
  const ArealMap half = gaussian_mean_surface(wave, 20e-6);
  for (std::size_t i = 60; i < 140; i += 7) EXPECT_NEAR(half.at(i, i + 3), 0.5 * wave.at(i, i + 3), 1e-4);
}

// Noise of a standard deviation and a correlation length that are known, drawn here as a sum of waves with random
// phases (correlated) or by another seed (independent), is within the stated errors.
TEST(ArealTexture, StandardErrorsCoverWhatNoiseDoes) {
  const auto truth = map_of(120, 100, 4e-6, 4e-6, [](double x, double y) {
    return kA_m * (std::sin(2 * pi * x / 60e-6) + std::sin(2 * pi * (0.8 * y + 0.3 * x) / 37e-6) +
                   0.5 * std::sin(2 * pi * (y - x) / 91e-6));
  });
  const ArealTextureResult want = measure_areal_texture(truth);
  EXPECT_TRUE(std::isnan(want.standard_error.Sq_m));
  for (const double correlation_m : {0.0, 20e-6}) {
    const ArealNoise noise{0.3e-6, {}, correlation_m, 0.0};
    int covered = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Random random(seed, 77);
      ArealMap measured = truth;
      if (correlation_m > 0.0) {
        // The correlation exp(−π r²/2w²) has the spectrum of wave numbers that are normal with √π/w an axis.
        const double w = correlation_m * std::sqrt(0.5 * pi / std::log(5.0)), k_sigma = std::sqrt(pi) / w;
        constexpr int kWaves = 400;
        for (int wave = 0; wave < kWaves; ++wave) {
          const double kx = k_sigma * random.normal(), ky = k_sigma * random.normal(),
                       phase = random.uniform(0, 2 * pi);
          for (std::size_t i = 0; i < measured.height_m.size(); ++i)
            measured.height_m[i] +=
                noise.rms_m * std::sqrt(2.0 / kWaves) *
                std::cos(kx * 4e-6 * static_cast<double>(i % 120) + ky * 4e-6 * static_cast<double>(i / 120) + phase);
        }
      } else {
        for (double& z : measured.height_m) z += noise.rms_m * random.normal();
      }
      const ArealTextureResult got = measure_areal_texture(measured, {}, noise);
      for (const ArealParameter& p : kArealParameters) {
        if (std::isnan(want.*p.value)) continue;
        const double error = got.standard_error.*p.value;
        ASSERT_GT(error, 0.0) << p.name;
        ++all;
        covered += std::abs(got.*p.value - want.*p.value) <= 2.0 * error ? 1 : 0;
      }
    }
    EXPECT_GE(covered, 0.9 * all) << "of " << all << ", correlation " << correlation_m;
    EXPECT_GE(all, 100);
  }
}

TEST(ArealTexture, ErrorsOfEachHeightMustBeAsMany) {
  const ArealMap map = map_of(20, 20, 1e-6, 1e-6, [](double x, double) { return x * x; });
  EXPECT_THROW(measure_areal_texture(map, {}, {1e-6, std::vector<double>(399, 1e-6), 0.0, 0.0}), Error);
}

}  // namespace
}  // namespace asperity
