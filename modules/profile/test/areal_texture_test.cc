#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Core>
#include <Eigen/QR>

#include "areal_gaussian_filter.h"
#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/random.h"
#include "asperity/profile/measure_areal_texture.h"
#include "robust_areal_filter.h"
#include "robust_gaussian_filter.h"
#include "surface_direction.h"

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
// Each wave counts once, also one along an axis, or of the shortest length that a map can have.
TEST(ArealTexture, OfTwoWavesTheStrongerOneIsTheLay) {
  const auto of_two = [](double axis_power, const auto& on_axis) {
    return lay_direction_rad(map_of(256, 256, 1e-6, 1e-6, [&](double x, double y) {
      return std::sqrt(axis_power) * kA_m * on_axis(x, y) + kA_m * std::sin(2 * pi * (x + y) / std::sqrt(2.0) / 6.4e-6);
    }));
  };
  const auto along_x = [](double x, double) { return std::sin(2 * pi * x / 6.4e-6); };
  const auto along_y = [](double, double y) { return std::sin(2 * pi * y / 6.4e-6); };
  // A direction is found to the cell of the spectrum: 6.4/256.
  constexpr double kCell_rad = 6.4 / 256.0;
  for (const double power : {0.75, 0.85}) {
    EXPECT_NEAR(of_two(power, along_x), 0.75 * pi, kCell_rad) << power;
    EXPECT_NEAR(of_two(power, along_y), 0.75 * pi, kCell_rad) << power;
  }
  EXPECT_NEAR(of_two(1.25, along_x), 0.5 * pi, kCell_rad);
  EXPECT_NEAR(std::remainder(of_two(1.25, along_y), pi), 0.0, kCell_rad);
}

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

// A map without gaps against the weighted least squares of a plane by orthogonal decomposition, in the corners, at the
// edges and inside; directly and by Fourier transforms.
TEST(ArealGaussian, AgreesWithThePlaneOfTheDefinitionUpToTheCorners) {
  Random random(11);
  const ArealMap map = map_of(140, 75, 1e-6, 1.5e-6, [&](double x, double) { return 2e4 * x + random.normal(); });
  const double alpha = std::sqrt(std::numbers::ln2 / pi);
  for (const double cutoff_m : {20e-6, 80e-6}) {
    const ArealMap smooth = gaussian_mean_surface(map, cutoff_m);
    for (const auto& [column, row] : {std::pair<int, int>{0, 0}, {139, 74}, {0, 40}, {70, 74}, {5, 3}, {70, 37}}) {
      std::vector<std::array<double, 4>> rows;
      for (int r = 0; r < 75; ++r) {
        for (int c = 0; c < 140; ++c) {
          const double x = 1e-6 * (c - column) / cutoff_m, y = 1.5e-6 * (r - row) / cutoff_m;
          const double w = std::exp(-0.5 * pi * (x * x + y * y) / (alpha * alpha));  // its root
          rows.push_back({w, w * x, w * y, w * map.at(static_cast<std::size_t>(r), static_cast<std::size_t>(c))});
        }
      }
      Eigen::MatrixXd A(static_cast<Eigen::Index>(rows.size()), 3);
      Eigen::VectorXd b(A.rows());
      for (Eigen::Index i = 0; i < A.rows(); ++i) {
        const auto& one = rows[static_cast<std::size_t>(i)];
        A.row(i) << one[0], one[1], one[2];
        b[i] = one[3];
      }
      // The weight is cut off at 7e-7 of its peak.
      EXPECT_NEAR(smooth.at(static_cast<std::size_t>(row), static_cast<std::size_t>(column)),
                  A.householderQr().solve(b)[0], 2e-5)
          << column << ' ' << row << ' ' << cutoff_m;
    }
  }
}

// The definition for a small map: weighted least squares of a quadric by orthogonal decomposition at every point, and
// Tukey's weights; nothing of it by moments or transforms.
std::vector<double> robust_by_definition(const ArealMap& map, double cutoff_m) {
  const double alpha = 0.7309134280946760;
  const std::size_t n = map.height_m.size();
  std::vector<double> trust(n), mean(n, kNan);
  for (std::size_t i = 0; i < n; ++i) trust[i] = std::isnan(map.height_m[i]) ? 0.0 : 1.0;
  double scale = 0.0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    std::vector<double> residuals;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::isnan(map.height_m[i])) continue;
      Eigen::MatrixXd A(static_cast<Eigen::Index>(n), 6);
      Eigen::VectorXd b(static_cast<Eigen::Index>(n));
      for (std::size_t j = 0; j < n; ++j) {
        const double x =
            map.x_spacing_m / cutoff_m * (static_cast<double>(j % map.columns) - static_cast<double>(i % map.columns));
        const double y =
            map.y_spacing_m / cutoff_m * (static_cast<double>(j / map.columns) - static_cast<double>(i / map.columns));
        const double w = std::sqrt(trust[j] * std::exp(-pi * (x * x + y * y) / (alpha * alpha)));
        A.row(static_cast<Eigen::Index>(j)) << w, w * x, w * y, w * x * x, w * x * y, w * y * y;
        b[static_cast<Eigen::Index>(j)] = trust[j] > 0.0 ? w * map.height_m[j] : 0.0;
      }
      mean[i] = A.householderQr().solve(b)[0];
      residuals.push_back(std::abs(map.height_m[i] - mean[i]));
    }
    std::sort(residuals.begin(), residuals.end());
    const double before = scale;
    scale = 4.4478 * residuals[residuals.size() / 2];
    if (std::abs(scale - before) <= 1e-4 * scale) break;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::isnan(map.height_m[i])) continue;
      const double r = (map.height_m[i] - mean[i]) / scale;
      trust[i] = std::abs(r) < 1.0 ? (1.0 - r * r) * (1.0 - r * r) : 0.0;
    }
  }
  return mean;
}

TEST(RobustAreal, AgreesWithTheDefinition) {
  Random random(3);
  ArealMap map = map_of(22, 17, 5e-6, 6e-6, [&](double x, double) { return 20.0 * x / 1e-4 + random.normal(); });
  for (const std::size_t pit : {40u, 41u, 200u, 201u, 222u, 223u}) map.height_m[pit] -= 30.0;
  for (const std::size_t hole : {0u, 1u, 100u, 150u, 151u, 373u}) map.height_m[hole] = kNan;
  const ArealMap mean = robust_gaussian_mean_surface(map, 45e-6);
  const std::vector<double> want = robust_by_definition(map, 45e-6);
  for (std::size_t i = 0; i < want.size(); ++i) {
    if (std::isnan(map.height_m[i])) {
      EXPECT_TRUE(std::isnan(mean.height_m[i]));
    } else {
      EXPECT_NEAR(mean.height_m[i], want[i], 1e-4) << "heights of 1; the weight's tail, cut at 7e-7, is left out";
    }
  }
}

TEST(RobustAreal, KeepsQuadricsAndIgnoresPits) {
  const auto quadric = map_of(160, 90, 2e-6, 3e-6, [](double x, double y) {
    return 1e-6 + 0.01 * x - 0.02 * y + 30.0 * x * x - 50.0 * x * y + 20.0 * y * y;
  });
  for (const double cutoff_m : {40e-6, 250e-6}) {  // directly, and by Fourier transforms
    const ArealMap kept = robust_gaussian_mean_surface(quadric, cutoff_m);
    for (std::size_t i = 0; i < kept.height_m.size(); ++i) EXPECT_NEAR(kept.height_m[i], quadric.height_m[i], 1e-13);
  }
  Random random(5);
  ArealMap pitted = map_of(160, 160, 2e-6, 2e-6, [&](double, double) { return 0.1e-6 * random.normal(); });
  const ArealMap without = robust_gaussian_mean_surface(pitted, 80e-6);
  for (std::size_t row = 0; row < 160; ++row) {
    for (std::size_t column = 0; column < 160; ++column) {
      if (row % 20 < 6 && column % 20 < 6) pitted.height_m[row * 160 + column] -= 10e-6;  // 9 % of the area
    }
  }
  const ArealMap robust = robust_gaussian_mean_surface(pitted, 80e-6), plain = gaussian_mean_surface(pitted, 80e-6);
  double worst_m = 0.0, mean_plain_m = 0.0;
  for (std::size_t i = 0; i < robust.height_m.size(); ++i) {
    worst_m = std::max(worst_m, std::abs(robust.height_m[i] - without.height_m[i]));
    mean_plain_m += (plain.height_m[i] - without.height_m[i]) / 25600.0;
  }
  // Noise of 0.1 µm over some hundred independent heights, at a corner over tens; 10 µm over 9 %: 0.9 µm.
  EXPECT_LT(worst_m, 0.1e-6);
  EXPECT_NEAR(mean_plain_m, -0.9e-6, 0.05e-6);
}

// Of heights that are the same in each row the best quadric at any point is the best parabola, and the weights are the
// profile's: another code, of one dimension. Both cut the weight's tail, at 1e-6 and 7e-7:
// at an edge, where the parabola is extrapolated into a pit of 20, that is 1.4e-4.
TEST(RobustAreal, AlongOneAxisItIsTheProfilesFilter) {
  constexpr std::size_t kColumns = 300, kRows = 40;
  Random random(8);
  std::vector<double> profile_m;
  for (std::size_t i = 0; i < kColumns; ++i) profile_m.push_back(random.normal() - (i % 50 < 6 ? 20.0 : 0.0));
  const std::vector<double> want = robust_gaussian_mean_line_m(profile_m, 2e-6, 60e-6);
  ArealMap map{2e-6, 3e-6, kColumns, kRows, {}};
  for (std::size_t row = 0; row < kRows; ++row)
    map.height_m.insert(map.height_m.end(), profile_m.begin(), profile_m.end());
  const ArealMap mean = robust_gaussian_mean_surface(map, 60e-6);
  for (std::size_t i = 0; i < map.height_m.size(); ++i) EXPECT_NEAR(mean.height_m[i], want[i % kColumns], 1e-3);
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
