#include "asperity/texture/map_strokes.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/texture/evaluate_spline_grid.h"

namespace asperity {
namespace {

using std::numbers::pi;
using Relief = std::function<double(double x_mm, double y_mm)>;

// 200 waves of 0.3 to 1.2 cycles/mm in all directions, 30 µm RMS: not of the form that the map assumes.
Relief random_waves(std::uint64_t seed) {
  Random random(seed);
  std::vector<std::array<double, 3>> waves;
  for (int i = 0; i < 200; ++i) {
    const double f = random.uniform(0.3, 1.2), angle = random.uniform(0.0, 2.0 * pi);
    waves.push_back({2.0 * pi * f * std::cos(angle), 2.0 * pi * f * std::sin(angle), random.uniform(0.0, 2.0 * pi)});
  }
  return [waves](double x_mm, double y_mm) {
    double out = 0.0;
    for (const auto& [kx, ky, phase] : waves)
      out += 30e-6 * std::sqrt(2.0 / 200.0) * std::cos(kx * x_mm + ky * y_mm + phase);
    return out;
  };
}

// A straight stroke from (x0, y0) to (x1, y1), mm, with an offset, a drift of 15 µm and white noise of 2 µm.
AreaStroke stroke_over(const Relief& relief, double x0, double y0, double x1, double y1, Random& random) {
  AreaStroke out;
  out.spacing_m = 50e-6;
  const double length = std::hypot(x1 - x0, y1 - y0), offset_m = 80e-6 * random.normal(), turn = random.uniform(0, 6.3);
  for (double s = 0.0; s <= length; s += 0.05) {
    const double x = x0 + s * (x1 - x0) / length, y = y0 + s * (y1 - y0) / length;
    out.x_m.push_back(1e-3 * x);
    out.y_m.push_back(1e-3 * y);
    out.height_m.push_back(relief(x, y) + offset_m + 15e-6 * std::sin(2.0 * pi * s / 30.0 + turn) +
                           2e-6 * random.normal());
  }
  out.noise_m = 2e-6;
  return out;
}

// 8 and 8 that cross, 1 mm apart.
std::vector<AreaStroke> crossing(const std::function<Relief(int stroke)>& relief, Random& random) {
  std::vector<AreaStroke> out;
  for (int i = 0; i < 8; ++i) out.push_back(stroke_over(relief(i), -6.0, i - 3.5, 6.0, i - 3.4, random));
  for (int i = 0; i < 8; ++i) out.push_back(stroke_over(relief(8 + i), i - 3.5, -6.0, i - 3.4, 6.0, random));
  return out;
}

TEST(MapStrokes, ErrorsAreAsLargeAsTheirSigma) {
  Random random(5);
  const Relief relief = random_waves(2);
  MapStrokesConfig config;
  config.shift_mm = 0.0;
  const StrokeMap map = map_strokes(crossing([&](int) { return relief; }, random), config);
  ASSERT_FALSE(map.texture.supported.empty());
  EXPECT_EQ(map.ties, 64u);
  EXPECT_GT(map.agreement, 0.9);
  EXPECT_NEAR(map.rms_m, 30e-6, 6e-6);
  const SplineGrid& g = map.texture.surface;
  double on_strokes = 0.0, near = 0.0, between = 0.0, far = 0.0, ratio = 0.0, count = 0.0;
  for (std::size_t r = 0; r < g.rows; ++r) {
    for (std::size_t c = 0; c < g.columns; ++c) {
      const double x = g.origin_x_m + static_cast<double>(c) * g.spacing_x_m;
      const double y = g.origin_y_m + static_cast<double>(r) * g.spacing_y_m;
      if (std::abs(x) > 3e-3 || std::abs(y) > 3e-3) continue;
      const double sigma = map.texture.sigma_m[r * g.columns + c];
      const double error = evaluate_height(g, x, y).height_m - relief(1e3 * x, 1e3 * y);
      ratio += std::pow(error / sigma, 2);
      count += 1.0;
      // To the nearest stroke, mm.
      const double dx = std::abs(1e3 * x - 0.5 - std::round(1e3 * x - 0.5)),
                   dy = std::abs(1e3 * y - 0.5 - std::round(1e3 * y - 0.5));
      if (std::min(dx, dy) < 0.08) {
        on_strokes += error * error;
        near += 1.0;
      }
      if (std::min(dx, dy) > 0.42) {
        between += error * error;
        far += 1.0;
      }
    }
  }
  ratio = std::sqrt(ratio / count);
  EXPECT_GT(ratio, 0.6);
  EXPECT_LT(ratio, 1.4);
  // On a stroke the height is known nearly to its noise, half a millimetre from any it is not.
  EXPECT_LT(std::sqrt(on_strokes / near), 6e-6);
  EXPECT_GT(std::sqrt(between / far), 2.0 * std::sqrt(on_strokes / near));
  EXPECT_GT(map.held_out.error_over_sigma, 0.6);
  EXPECT_LT(map.held_out.error_over_sigma, 1.4);
}

TEST(MapStrokes, StrokesOfDifferentSurfacesDoNotAgree) {
  Random random(7);
  const StrokeMap map =
      map_strokes(crossing([](int k) { return random_waves(static_cast<std::uint64_t>(100 + k)); }, random));
  EXPECT_LT(map.agreement + 2.0 * map.agreement_sigma, 0.5);
  EXPECT_LT(std::abs(map.agreement), 3.0 * map.agreement_sigma);
}

TEST(MapStrokes, FarApartStrokesAreNotCompared) {
  Random random(8);
  const Relief relief = random_waves(4);
  std::vector<AreaStroke> strokes;
  for (int i = 0; i < 4; ++i) strokes.push_back(stroke_over(relief, -8.0, 5.0 * i, 8.0, 5.0 * i, random));
  const StrokeMap map = map_strokes(strokes);
  EXPECT_EQ(map.ties, 0u);
  EXPECT_TRUE(map.texture.supported.empty());
  EXPECT_TRUE(std::isnan(map.agreement));
  EXPECT_THROW(map_strokes({}), Error);
}

TEST(MapStrokes, GivesTheSameBitsAgain) {
  Random one(9), two(9);
  const Relief relief = random_waves(5);
  MapStrokesConfig config;
  config.held_out = 3;
  const StrokeMap a = map_strokes(crossing([&](int) { return relief; }, one), config);
  const StrokeMap b = map_strokes(crossing([&](int) { return relief; }, two), config);
  EXPECT_EQ(a.texture.surface.coefficient_m, b.texture.surface.coefficient_m);
  EXPECT_EQ(a.texture.sigma_m, b.texture.sigma_m);
}

TEST(ArealSpectrum, SectionAndCovarianceBelongTogether) {
  for (const double t : {-0.8, 0.0, 1.0, 2.5}) {
    const ArealSpectrum s{2e-9, 3.0, t};
    // The variance is the section's power, and the plane's: ∫ P k dk / 2π, both by brute force.
    double section = 0.0, plane = 0.0;
    for (double q = 5e-3; q < 2000.0; q += 1e-2) {
      section += s.section_m2mm(q) * 1e-2 / pi;
      plane += 2e-9 / (std::pow(q, 4) + 2.0 * t * 9.0 * q * q + 81.0) * q * 1e-2 / (2.0 * pi);
    }
    EXPECT_NEAR(section / s.variance_m2(), 1.0, 1e-3) << t;
    EXPECT_NEAR(plane / s.variance_m2(), 1.0, 1e-3) << t;
    EXPECT_NEAR(s.covariance_m2(1e-4) / s.variance_m2(), 1.0, 3e-3) << t;
    // Matérn's with ν = 1: ρ = κ r K₁(κ r).
    if (t == 1.0) {
      EXPECT_NEAR(s.covariance_m2(0.4) / s.variance_m2(), 1.2 * std::cyl_bessel_k(1.0, 1.2), 2e-3);
    }
  }
}

TEST(ArealSpectrum, IsFoundAgainFromItsSection) {
  for (const ArealSpectrum& truth : {ArealSpectrum{1e-9, 4.0, -0.5}, ArealSpectrum{3e-9, 2.0, 1.0}}) {
    std::vector<double> frequency, density;
    for (double f = 0.2; f < 3.0; f += 0.1) {
      frequency.push_back(f);
      density.push_back(2.0 * truth.section_m2mm(2.0 * pi * f));
    }
    const ArealSpectrum found = fit_areal_spectrum(frequency, density);
    EXPECT_NEAR(found.kappa_per_mm / truth.kappa_per_mm, 1.0, 0.02);
    EXPECT_NEAR(found.t, truth.t, 0.05);
    EXPECT_NEAR(found.A / truth.A, 1.0, 0.05);
  }
}

}  // namespace
}  // namespace asperity
