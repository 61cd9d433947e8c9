#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/profile/measure_areal_texture.h"

namespace asperity {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

template <class Height>
ArealMap map_of(std::size_t columns, std::size_t rows, double x_spacing_m, double y_spacing_m, const Height& height_m) {
  ArealMap map{x_spacing_m, y_spacing_m, columns, rows, {}};
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      map.height_m.push_back(
          height_m(static_cast<double>(column) * x_spacing_m, static_cast<double>(row) * y_spacing_m));
    }
  }
  return map;
}

TEST(ArealRoughness, CrossedCosinesOnAPlaneHaveAnalyticValues) {
  constexpr double kA_m = 2e-6;
  // Whole periods, symmetric about the middle: the cosines have no part along the plane.
  const ArealMap map = map_of(201, 101, 5e-6, 10e-6, [](double x, double y) {
    return kA_m * std::cos(2 * pi * (x + 2.5e-6) / (201 * 5e-6 / 6)) *
               std::cos(2 * pi * (y + 5e-6) / (101 * 10e-6 / 4)) +
           4e-4 + 0.01 * x - 0.02 * y;
  });
  const ArealTextureResult r = measure_areal_texture(map);
  EXPECT_NEAR(r.Sa_m, kA_m * 4 / (pi * pi), 2e-3 * kA_m);
  EXPECT_NEAR(r.Sq_m, kA_m / 2, 1e-9 * kA_m);
  EXPECT_NEAR(r.Ssk, 0.0, 1e-6);
  EXPECT_NEAR(r.Sku, 2.25, 1e-6);
  EXPECT_NEAR(r.slope_x, 0.01, 1e-12);
  EXPECT_NEAR(r.slope_y, -0.02, 1e-12);
  EXPECT_NEAR(r.Sz_m, r.Sp_m + r.Sv_m, 1e-18);
  EXPECT_NEAR(r.Sz_m, 2 * kA_m, 5e-3 * kA_m);
}

TEST(ArealRoughness, AgreesWithBruteForceWithHoles) {
  auto map = map_of(17, 13, 1e-3, 2e-3,
                    [](double x, double y) { return std::sin(900 * x) * std::cos(400 * y * y + x) + 3 * x + y; });
  for (std::size_t i = 0; i < map.height_m.size(); i += 5) map.height_m[i] = std::numeric_limits<double>::quiet_NaN();
  const ArealTextureResult r = measure_areal_texture(map);
  EXPECT_EQ(r.missing, 45u);
  // The residual of a least-squares plane is orthogonal to 1, x and y, and no other plane has a smaller one.
  const auto rms_of = [&](double slope_x, double slope_y) {
    double sum = 0.0, square = 0.0, n = 0.0;
    for (std::size_t row = 0; row < map.rows; ++row) {
      for (std::size_t column = 0; column < map.columns; ++column) {
        const double z = map.at(row, column);
        if (std::isnan(z)) continue;
        const double h = z - slope_x * static_cast<double>(column) * map.x_spacing_m -
                         slope_y * static_cast<double>(row) * map.y_spacing_m;
        sum += h;
        square += h * h;
        n += 1.0;
      }
    }
    return std::sqrt(square / n - sum * sum / n / n);
  };
  const double best = rms_of(r.slope_x, r.slope_y);
  EXPECT_NEAR(r.Sq_m, best, 1e-12);
  for (const double step : {-1e-2, 1e-2}) {
    EXPECT_GT(rms_of(r.slope_x + step, r.slope_y), best);
    EXPECT_GT(rms_of(r.slope_x, r.slope_y + step), best);
  }
}

TEST(ArealRoughness, KeepsThePlaneWhenAsked) {
  const ArealMap map = map_of(101, 3, 1e-6, 1e-6, [](double x, double) { return x; });
  EXPECT_LT(measure_areal_texture(map).Sq_m, 1e-18);
  // A ramp of N steps has the variance (N² − 1) / 12.
  EXPECT_NEAR(measure_areal_texture(map, {.form = ArealForm::kMean}).Sq_m, 1e-6 * std::sqrt((101.0 * 101.0 - 1) / 12),
              1e-15);
}

TEST(ArealRoughness, RefusesWhatHasNoMeaning) {
  ArealMap map = map_of(4, 4, 1e-6, 1e-6, [](double, double) { return 0.0; });
  map.height_m[6] = std::numeric_limits<double>::infinity();
  EXPECT_THAT([&] { measure_areal_texture(map); }, ThrowsMessage<Error>(HasSubstr("row 2, column 3")));
  map.height_m.pop_back();
  EXPECT_THAT([&] { measure_areal_texture(map); }, ThrowsMessage<Error>(HasSubstr("15 heights for a map of 4 by 4")));
  map = map_of(4, 4, 1e-6, 1e-6,
               [](double, double y) { return y > 1e-6 ? std::numeric_limits<double>::quiet_NaN() : 0.0; });
  for (std::size_t i = 4; i < 8; ++i) map.height_m[i] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { measure_areal_texture(map, {.max_missing = 0.9}); },
              ThrowsMessage<Error>(HasSubstr("are on one line")));
}

}  // namespace
}  // namespace asperity
