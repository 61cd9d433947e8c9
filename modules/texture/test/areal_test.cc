#include "asperity/texture/fit_areal.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/texture/evaluate_spline_grid.h"

namespace asperity {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

template <class Height>
std::vector<ArealSample> scattered(int count, const Height& height_m) {
  Random random(1);
  std::vector<ArealSample> samples;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(0.0, 8e-3);
    const double y = random.uniform(0.0, 5e-3);
    samples.push_back({x, y, height_m(x, y)});
  }
  return samples;
}

TEST(FitAreal, KeepsAPlaneExactly) {
  const auto plane = [](double x, double y) { return 1e-4 + 0.01 * x - 0.02 * y; };
  FitArealConfig config;
  config.spacing_mm = 0.5;
  const ArealFit fit = fit_areal(scattered(2000, plane), config);
  // A plane has no curvature to be held against.
  EXPECT_LT(fit.rms_error_m, 1e-6 * fit.rms_height_m);
  for (double x = 0.2e-3; x < 7.8e-3; x += 0.37e-3) {
    const HeightAndGradient h = evaluate_height(fit.texture.surface, x, 2.1e-3);
    EXPECT_NEAR(h.height_m, plane(x, 2.1e-3), 1e-9);
    EXPECT_NEAR(h.slope_x, 0.01, 1e-5);
    EXPECT_NEAR(h.slope_y, -0.02, 1e-5);
  }
}

// By default nothing that was measured is thrown away: an areal map gives a surface of its own points.
TEST(FitAreal, TakesTheSpacingOfTheData) {
  const auto wave = [](double x, double y) {
    return 5e-6 * std::sin(2 * pi * x / 60e-6) * std::cos(2 * pi * y / 80e-6);
  };
  std::vector<ArealSample> map;
  for (int r = 0; r < 61; ++r)
    for (int c = 0; c < 81; ++c) map.push_back({10e-6 * c, 10e-6 * r, wave(10e-6 * c, 10e-6 * r)});
  map[1000].height_m = std::numeric_limits<double>::quiet_NaN();
  const ArealFit fit = fit_areal(map);
  EXPECT_NEAR(fit.texture.surface.spacing_x_m, 10e-6, 1e-9);
  EXPECT_NEAR(fit.texture.surface.spacing_y_m, 10e-6, 1e-9);
  EXPECT_GE(fit.texture.surface.columns, 81u);
  EXPECT_GE(fit.texture.surface.rows, 61u);
  EXPECT_LT(fit.rms_error_m, 0.02 * fit.rms_height_m);  // smoothness 1e-3 on six points a wave
  // Scattered: √(8 mm · 5 mm / 40000) = 32 µm; few samples: 0.1 mm as a surface needs between strokes.
  const auto plane = [](double x, double) { return 0.01 * x; };
  EXPECT_NEAR(fit_areal(scattered(40000, plane)).texture.surface.spacing_x_m, 32e-6, 1e-6);
  EXPECT_NEAR(fit_areal(scattered(500, plane)).texture.surface.spacing_x_m, 0.1e-3, 1e-6);
}

TEST(FitAreal, FindsWavesFromManyNoisyStrokes) {
  Random random(2);
  const auto wave = [](double x, double y) {
    return 20e-6 * std::sin(2 * pi * x / 2e-3) * std::cos(2 * pi * y / 3e-3);
  };
  std::vector<ArealSample> samples;
  for (int stroke = 0; stroke < 40; ++stroke) {
    for (int i = 0; i < 320; ++i) {
      const double x = 25e-6 * i;
      const double y = 5e-3 * stroke / 39.0;
      samples.push_back({x, y, wave(x, y) + 1e-6 * random.normal()});
    }
  }
  FitArealConfig config;
  config.spacing_mm = 0.2;
  config.smoothness = 0.01;
  const ArealFit fit = fit_areal(samples, config);
  EXPECT_LT(fit.relative_residual, 1e-6);
  // What is left is the noise of 1 µm; the surface itself lies closer to the truth.
  EXPECT_NEAR(fit.rms_error_m, 1e-6, 0.1e-6);
  double square = 0.0;
  int count = 0;
  for (double x = 0.0; x <= 7.9e-3; x += 0.1e-3) {
    for (double y = 0.0; y <= 5e-3; y += 0.1e-3, ++count)
      square += std::pow(evaluate_height(fit.texture.surface, x, y).height_m - wave(x, y), 2);
  }
  EXPECT_LT(std::sqrt(square / count), 0.6e-6);
  EXPECT_NEAR(fit.height_offset_m, 20e-6, 2e-6);
}

TEST(FitAreal, MarksGapsAndBridgesThemSmoothly) {
  const auto bowl = [](double x, double y) { return 2.0 * ((x - 4e-3) * (x - 4e-3) + (y - 2.5e-3) * (y - 2.5e-3)); };
  auto samples = scattered(8000, bowl);
  std::size_t missing = 0;
  for (auto& s : samples) {
    if (std::hypot(s.x_m - 4e-3, s.y_m - 2.5e-3) < 1e-3)
      s.height_m = std::numeric_limits<double>::quiet_NaN(), ++missing;
  }
  const ArealFit fit = fit_areal(samples, {.spacing_mm = 0.2, .smoothness = 1e-4, .iterations = 2000});
  ASSERT_EQ(fit.problems.size(), 2u);
  EXPECT_EQ(fit.problems[0].kind, "missing_heights");
  EXPECT_EQ(fit.problems[0].count, missing);
  EXPECT_EQ(fit.problems[1].kind, "areal_gaps");
  EXPECT_LT(fit.supported_part, 1.0);
  const SplineGrid& g = fit.texture.surface;
  for (std::size_t r = 0; r < g.rows; ++r) {
    for (std::size_t c = 0; c < g.columns; ++c) {
      const double x = g.origin_x_m + g.spacing_x_m * static_cast<double>(c);
      const double y = g.origin_y_m + g.spacing_y_m * static_cast<double>(r);
      const double from_centre = std::hypot(x - 4e-3, y - 2.5e-3);
      if (from_centre < 0.6e-3) {
        EXPECT_EQ(fit.texture.supported[r * g.columns + c], 0);
      }
      if (from_centre > 1.3e-3 && x > 0.3e-3 && x < 7.7e-3 && y > 0.3e-3 && y < 4.7e-3) {
        EXPECT_EQ(fit.texture.supported[r * g.columns + c], 1) << x << " " << y;
      }
    }
  }
  // A thin plate over the hole of 1 mm: the bowl's 2 µm of sag are met to a third.
  EXPECT_NEAR(evaluate_height(g, 4e-3, 2.5e-3).height_m, bowl(4e-3, 2.5e-3), 0.7e-6);
}

TEST(FitAreal, RepeatsWhereAskedTo) {
  const auto wave = [](double x, double y) {
    return 10e-6 * std::sin(2 * pi * x / 2e-3) + 5e-6 * std::cos(2 * pi * y / 1e-3);
  };
  FitArealConfig config;
  config.border = Border::kPeriodic;
  config.period_x_mm = 8.0;
  config.period_y_mm = 5.0;
  const ArealFit fit = fit_areal(scattered(20000, wave), config);
  for (double x = -10e-3; x < 10e-3; x += 0.77e-3)
    EXPECT_NEAR(evaluate_height(fit.texture.surface, x, 2 * x).height_m, wave(x, 2 * x), 0.2e-6) << x;
}

TEST(SplineGrid, IsSmoothAcrossItsBorders) {
  const auto wave = [](double x, double y) { return 10e-6 * std::sin(2 * pi * x / 2e-3) + 0.003 * y; };
  for (const Border border : {Border::kClamp, Border::kMirror}) {
    FitArealConfig config;
    config.spacing_mm = 0.25;
    config.border = border;
    const ArealFit fit = fit_areal(scattered(5000, wave), config);
    constexpr double kStep_m = 1e-9;
    for (double s = -12e-3; s < 20e-3; s += 3.1e-6) {
      const HeightAndGradient a = evaluate_height(fit.texture.surface, s, 0.6 * s);
      const HeightAndGradient b = evaluate_height(fit.texture.surface, s + kStep_m, 0.6 * (s + kStep_m));
      ASSERT_NEAR(b.height_m - a.height_m, kStep_m * (a.slope_x + 0.6 * a.slope_y), 1e-14) << s;
      ASSERT_NEAR(a.slope_x, b.slope_x, 1e-5) << s;
      ASSERT_NEAR(a.slope_y, b.slope_y, 1e-5) << s;
    }
    // Nothing steeper than inside, however far out.
    EXPECT_LT(std::abs(evaluate_height(fit.texture.surface, 1.0, -3.0).height_m), 40e-6);
  }
}

TEST(FitAreal, RefusesWhatIsNoSurface) {
  std::vector<ArealSample> line;
  for (int i = 0; i < 100; ++i) line.push_back({1e-4 * i, 0.0, 0.0});
  EXPECT_THAT([&] { fit_areal(line); }, ThrowsMessage<Error>(HasSubstr("on one line")));
  line[3].x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { fit_areal(line); }, ThrowsMessage<Error>(HasSubstr("sample 4")));
  EXPECT_THAT([&] { fit_areal({}); }, ThrowsMessage<Error>(HasSubstr("0 heights")));
  const auto flat = scattered(100, [](double, double) { return 0.0; });
  EXPECT_THAT([&] { fit_areal(flat, {.spacing_mm = 1e-4}); }, ThrowsMessage<Error>(HasSubstr("points a side")));
}

}  // namespace
}  // namespace asperity
