// The tables against the sum in long double, images and splines against the texture module, and places far out.
#include "asperity/render/render_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/synthesize_isotropic.h"

namespace asperity {
namespace {

Texture of(TextureModel model) {
  Texture texture;
  texture.model = std::move(model);
  return texture;
}

Fourier1d series(std::size_t harmonics, double exponent, double length_mm, double mean_m, std::uint64_t seed) {
  Random random(seed);
  Fourier1d f{length_mm, {}, {}, mean_m};
  for (std::size_t j = 1; j <= harmonics; ++j) {
    const double amplitude_m = 1e-5 * std::pow(static_cast<double>(j), exponent);
    f.a_m.push_back(amplitude_m * random.normal());
    f.b_m.push_back(amplitude_m * random.normal());
  }
  return f;
}

struct Exact {
  long double height_m = 0.0L;
  long double slope = 0.0L;
};

Exact exact(const Fourier1d& f, double x_m) {
  const long double length_m = static_cast<long double>(f.length_mm) * 1e-3L;
  const long double omega = 2.0L * std::numbers::pi_v<long double> / length_m;
  // Whole periods are taken off in full precision: a sine of a large angle would be the error then.
  const long double x = std::fmod(static_cast<long double>(x_m), length_m);
  Exact e{f.mean_m, 0.0L};
  for (std::size_t j = 0; j < f.a_m.size(); ++j) {
    const long double k = omega * static_cast<long double>(j + 1);
    e.height_m += f.a_m[j] * std::cos(k * x) + f.b_m[j] * std::sin(k * x);
    e.slope += k * (f.b_m[j] * std::cos(k * x) - f.a_m[j] * std::sin(k * x));
  }
  return e;
}

double rms_m(const Fourier1d& f) {
  double power = 0.0;
  for (std::size_t j = 0; j < f.a_m.size(); ++j) power += 0.5 * (f.a_m[j] * f.a_m[j] + f.b_m[j] * f.b_m[j]);
  return std::sqrt(power);
}

double rms_slope(const Fourier1d& f) {
  double power = 0.0;
  for (std::size_t j = 0; j < f.a_m.size(); ++j) {
    const double k = 2e3 * std::numbers::pi / f.length_mm * static_cast<double>(j + 1);
    power += 0.5 * k * k * (f.a_m[j] * f.a_m[j] + f.b_m[j] * f.b_m[j]);
  }
  return std::sqrt(power);
}

constexpr double kHeightError = 1e-6;  // of RMS, as promised
constexpr double kSlopeError = 1e-4;

TEST(RenderHeight, OfASeriesIsItsSum) {
  Fourier1d last = series(128, 0.0, 10.0, 0.0, 3);  // the hardest: all power in the last harmonic
  for (std::size_t j = 0; j < 127; ++j) last.a_m[j] = last.b_m[j] = 0.0;
  for (const Fourier1d& f : {series(128, 0.0, 10.0, 0.0, 1), series(128, -1.0, 7.3, 2e-4, 2), last,
                             series(1, 0.0, 2.5, 0.0, 4), series(500, -0.5, 40.0, 0.0, 5)}) {
    const RenderTexture texture = make_render_texture(of(f), {});
    ASSERT_FALSE(texture.tables.x_table.cells.empty());
    Random random(6);
    double height = 0.0, slope = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const double x_m = random.uniform(-0.1, 0.1);
      const HeightAndGradient h = render_height(texture, x_m, random.uniform(-1.0, 1.0));
      const Exact e = exact(f, x_m);
      if (h.height_m == 0.0) continue;  // at the lowest point, where the table may lie below the surface
      height = std::max(height, std::abs(static_cast<double>(h.height_m - texture.height_offset_m - e.height_m)));
      slope = std::max(slope, std::abs(static_cast<double>(h.slope_x - e.slope)));
      EXPECT_EQ(h.slope_y, 0.0);
    }
    EXPECT_LE(height, kHeightError * rms_m(f)) << f.a_m.size();
    EXPECT_LE(slope, kSlopeError * rms_slope(f)) << f.a_m.size();
  }
}

// The slope is that of the height that is rendered, not only near the exact one.
TEST(RenderHeight, HasTheSlopeOfItsOwnHeight) {
  const Fourier1d f = series(64, -0.5, 10.0, 0.0, 1);
  const RenderTexture texture = make_render_texture(of(f), {});
  Random random(2);
  constexpr double kStep_m = 1e-7;
  for (int i = 0; i < 2000; ++i) {
    const double x_m = random.uniform(-0.02, 0.02);
    const double rise =
        (render_height(texture, x_m + kStep_m, 0.0).height_m - render_height(texture, x_m - kStep_m, 0.0).height_m) /
        (2.0 * kStep_m);
    // Third derivatives times a step squared, and 1e-19 m of rounding over 2e-7 m.
    EXPECT_NEAR(render_height(texture, x_m, 0.0).slope_x, rise, 1e-5 * rms_slope(f));
  }
}

TEST(RenderHeight, OfAProductIsTheProduct) {
  Fourier2d product;
  product.kind = Fourier2dKind::kPattern;
  product.x = series(128, -0.5, 10.0, 3e-4, 1);
  product.y = series(40, 0.0, 6.0, 2e-4, 2);
  product.scale_per_m = -2e3;
  product.offset_m = 1e-4;
  const RenderTexture texture = make_render_texture(of(product), {});
  ASSERT_FALSE(texture.tables.x_table.cells.empty());
  Random random(3);
  double height = 0.0, slope_x = 0.0, slope_y = 0.0, mean = 0.0, square = 0.0, square_x = 0.0, square_y = 0.0;
  constexpr int kPlaces = 6000;
  for (int i = 0; i < kPlaces; ++i) {
    const double x_m = random.uniform(-0.03, 0.03);
    const double y_m = random.uniform(-0.03, 0.03);
    const Exact x = exact(product.x, x_m);
    const Exact y = exact(product.y, y_m);
    const auto h = static_cast<double>(1e-4L - 2e3L * x.height_m * y.height_m);
    const auto hx = static_cast<double>(-2e3L * x.slope * y.height_m);
    const auto hy = static_cast<double>(-2e3L * x.height_m * y.slope);
    mean += h / kPlaces;
    square += h * h / kPlaces;
    square_x += hx * hx / kPlaces;
    square_y += hy * hy / kPlaces;
    const HeightAndGradient r = render_height(texture, x_m, y_m);
    height = std::max(height, std::abs(r.height_m - texture.height_offset_m - h));
    slope_x = std::max(slope_x, std::abs(r.slope_x - hx));
    slope_y = std::max(slope_y, std::abs(r.slope_y - hy));
  }
  EXPECT_LE(height, kHeightError * std::sqrt(square - mean * mean));
  EXPECT_LE(slope_x, kSlopeError * std::sqrt(square_x));
  EXPECT_LE(slope_y, kSlopeError * std::sqrt(square_y));
}

// Steep images of chance, every border; and a spline. The same formula in another order: a few roundings apart.
TEST(RenderHeight, OfImagesAndSplinesIsTheTextureModules) {
  Random random(1);
  std::vector<Texture> textures;
  for (const Border border : {Border::kClamp, Border::kMirror, Border::kPeriodic}) {
    HeightMap map{23, 17, 0.1, 0.15, 0.0, 1e-3, 16, border, {}};
    for (int i = 0; i < 23 * 17; ++i) map.level.push_back(static_cast<std::uint16_t>(random.bits() & 0xffff));
    textures.push_back(of(map));
    SplineGrid grid{20, 15, 1e-4, 2e-4, -1e-3, 5e-4, border, {}};
    for (int i = 0; i < 20 * 15; ++i) grid.coefficient_m.push_back(random.uniform(0.0, 1e-3));
    textures.push_back(of(ArealTexture{grid, {}}));
  }
  HeightMap least{4, 4, 0.1, 0.1, 0.0, 1e-3, 8, Border::kPeriodic, {}};
  for (int i = 0; i < 16; ++i) least.level.push_back(static_cast<std::uint16_t>(random.bits() & 0xff));
  textures.push_back(of(least));
  Fourier2d isotropic;
  isotropic.kind = Fourier2dKind::kIsotropic;
  isotropic.isotropic.power_m2.assign(8, 1e-12);
  isotropic.grid = synthesize_isotropic(isotropic.isotropic);
  textures.push_back(of(isotropic));
  for (const Texture& source : textures) {
    const RenderTexture texture = make_render_texture(source, {});
    for (int i = 0; i < 20000; ++i) {
      const double x_m = random.uniform(-0.005, 0.005);
      const double y_m = random.uniform(-0.005, 0.005);
      const HeightAndGradient wanted = evaluate_height(source.model, x_m, y_m);
      const HeightAndGradient h = render_height(texture, x_m, y_m);
      if (h.height_m == 0.0) continue;
      EXPECT_NEAR(h.height_m - texture.height_offset_m, wanted.height_m, 1e-15);
      EXPECT_NEAR(h.slope_x, wanted.slope_x, 1e-10);
      EXPECT_NEAR(h.slope_y, wanted.slope_y, 1e-10);
    }
  }
}

// A wall of a period in whole powers of two: the same bits, period after period.
TEST(RenderHeight, RepeatsExactly) {
  Fourier1d f = series(32, -1.0, 8.0, 0.0, 1);
  f.length_mm = 1e3 / 128;
  const RenderTexture texture = make_render_texture(of(f), {});
  for (double x_m = 0.0; x_m < 1.0 / 128; x_m += 0x1p-17) {
    const HeightAndGradient here = render_height(texture, x_m, 0.0);
    for (const double periods : {-70000.0, -3.0, -1.0, 1.0, 5.0, 123456.0}) {
      const HeightAndGradient there = render_height(texture, x_m + periods / 128, 0.0);
      EXPECT_EQ(here.height_m, there.height_m);
      EXPECT_EQ(here.slope_x, there.slope_x);
    }
  }
}

TEST(RenderHeight, IsBoundedFarOutAndZeroNowhere) {
  std::vector<Texture> textures{of(series(16, 0.0, 10.0, 0.0, 1))};
  Fourier2d product;
  product.x = product.y = series(16, 0.0, 10.0, 1e-4, 2);
  textures.push_back(of(product));
  HeightMap map{8, 8, 0.1, 0.1, 0.0, 1e-3, 8, Border::kPeriodic, std::vector<std::uint16_t>(64, 100)};
  map.level[9] = 200;
  textures.push_back(of(map));
  map.border = Border::kMirror;
  textures.push_back(of(map));
  for (const Texture& source : textures) {
    const RenderTexture texture = make_render_texture(source, {});
    for (double x_m = 1e-300; x_m < 1e300; x_m *= 7.3) {
      for (const double sign : {-1.0, 1.0}) {
        const HeightAndGradient h = render_height(texture, sign * x_m, -sign * x_m);
        EXPECT_GE(h.height_m, 0.0);
        EXPECT_LE(h.height_m, texture.highest_m * (1.0 + 1e-3));
        EXPECT_TRUE(std::isfinite(h.slope_x) && std::isfinite(h.slope_y));
      }
    }
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::max()}) {
      const HeightAndGradient h = render_height(texture, bad, 0.0);
      EXPECT_TRUE(std::isfinite(h.height_m) && std::isfinite(h.slope_x) && std::isfinite(h.slope_y));
      EXPECT_TRUE(std::isfinite(bad) || (h.height_m == 0.0 && h.slope_x == 0.0 && h.slope_y == 0.0));
    }
  }
}

TEST(RenderHeight, ScalesWithItsTexture) {
  const Fourier1d f = series(64, -0.5, 10.0, 0.0, 1);
  Fourier1d large = f;
  large.length_mm *= 1024.0;
  for (double& a : large.a_m) a *= 1024.0;
  for (double& b : large.b_m) b *= 1024.0;
  const RenderTexture small_texture = make_render_texture(of(f), {});
  const RenderTexture large_texture = make_render_texture(of(large), {});
  for (double x_m = -0.01; x_m < 0.01; x_m += 1.7e-5) {
    const HeightAndGradient a = render_height(small_texture, x_m, 0.0);
    const HeightAndGradient b = render_height(large_texture, 1024.0 * x_m, 0.0);
    EXPECT_EQ(1024.0 * a.height_m, b.height_m);
    EXPECT_EQ(a.slope_x, b.slope_x);
  }
}

// All power in harmonic 40000: some 200000 cells.
TEST(RenderHeight, HasNoTableThatWouldBeTooLarge) {
  Fourier1d f{10.0, std::vector<double>(40000, 0.0), std::vector<double>(40000, 0.0), 0.0};
  f.a_m.back() = 1e-6;
  EXPECT_TRUE(make_periodic_table(f, kHeightError * rms_m(f), kSlopeError * rms_slope(f)).cells.empty());
}

}  // namespace
}  // namespace asperity
