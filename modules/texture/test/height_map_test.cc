#include "asperity/texture/make_height_map.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/image/png_image.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/evaluate_height_map.h"
#include "asperity/texture/fit_fourier2d.h"

namespace asperity {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

DeepGrayImage noise(int columns, int rows, int bits) {
  Random random(1);
  DeepGrayImage image{columns, rows, {}, bits};
  for (int i = 0; i < columns * rows; ++i)
    image.pixels.push_back(static_cast<std::uint16_t>(random.bits() & (bits == 8 ? 0xFF : 0xFFFF)));
  return image;
}

TEST(Png, ComesBackBitForBit) {
  for (const int bits : {8, 16}) {
    const DeepGrayImage image = noise(37, 11, bits);
    const DeepGrayImage back = parse_png(format_png(image), "x.png");
    EXPECT_EQ(back.width, 37);
    EXPECT_EQ(back.height, 11);
    EXPECT_EQ(back.bits, bits);
    EXPECT_EQ(back.pixels, image.pixels);
    EXPECT_EQ(format_png(image), format_png(back));
  }
}

// 2 x 2 pixels of 16 bits, 0, 1, 256 and 65535, written with Python's zlib and struct alone.
constexpr unsigned char kForeign[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00,
    0x02, 0x00, 0x00, 0x00, 0x02, 0x10, 0x00, 0x00, 0x00, 0x00, 0x07, 0x4d, 0x8e, 0xbb, 0x00, 0x00, 0x00, 0x10, 0x49,
    0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x60, 0x60, 0x60, 0x04, 0xc2, 0xff, 0xff, 0x01, 0x03, 0x11, 0x02, 0x01,
    0xda, 0xe7, 0xa3, 0x7f, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

TEST(Png, ReadsAnotherProgramsImage) {
  const DeepGrayImage image = parse_png({reinterpret_cast<const char*>(kForeign), sizeof kForeign}, "x.png");
  EXPECT_EQ(image.bits, 16);
  EXPECT_THAT(image.pixels, testing::ElementsAre(0, 1, 256, 65535));
}

TEST(Png, RefusesWhatIsDamagedOrNotGrey) {
  const std::string good = format_png(noise(16, 16, 8));
  EXPECT_THAT([&] { parse_png("", "x.png"); }, ThrowsMessage<Error>(HasSubstr("x.png: is not a PNG image")));
  for (std::size_t size = 8; size + 12 < good.size(); size += 7) {
    EXPECT_THAT([&] { parse_png(std::string_view(good).substr(0, size), "x.png"); },
                ThrowsMessage<Error>(HasSubstr("damaged")))
        << size;
  }
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 0x55);
  EXPECT_THROW(parse_png(flipped, "x.png"), Error);
  // A header that promises 65535 x 65535 pixels: refused before the memory is taken.
  std::string huge = good;
  for (const std::size_t at : {18u, 19u, 22u, 23u}) huge[at] = '\xFF';
  EXPECT_THROW(parse_png(huge, "x.png"), Error);
  EXPECT_THROW(format_png(DeepGrayImage{3, 3, {1, 2}, 8}), Error);
  EXPECT_THROW(format_png(DeepGrayImage{1, 1, {300}, 8}), Error);
}

HeightMap map_of(std::size_t columns, std::size_t rows, Border border) {
  const DeepGrayImage image = noise(static_cast<int>(columns), static_cast<int>(rows), 16);
  return {columns, rows, 0.04, 0.05, -1e-5, 2e-5, 16, border, image.pixels};
}

TEST(EvaluateHeightMap, PassesThroughItsPixels) {
  const HeightMap map = map_of(20, 30, Border::kPeriodic);
  for (std::size_t r = 0; r < 30; ++r) {
    for (std::size_t c = 0; c < 20; ++c) {
      const double wanted = -1e-5 + 3e-5 * map.level[r * 20 + c] / 65535.0;
      const double x = 0.04e-3 * static_cast<double>(c);
      const double y = 0.05e-3 * static_cast<double>(r);
      EXPECT_NEAR(evaluate_height(map, x, y).height_m, wanted, 1e-17);
      // And again a period of 20 x 0.04 mm and 30 x 0.05 mm further on; positions round.
      EXPECT_NEAR(evaluate_height(map, x + 3 * 0.8e-3, y - 2 * 1.5e-3).height_m, wanted, 1e-15);
    }
  }
}

TEST(EvaluateHeightMap, IsSmoothEverywhere) {
  for (const Border border : {Border::kClamp, Border::kMirror, Border::kPeriodic}) {
    const HeightMap map = map_of(12, 9, border);
    constexpr double kStep_m = 1e-9;
    // Slopes of noise reach 3e-5 m in 4e-5 m; they may change by curvature times step, no more.
    for (double s = -1.3e-3; s < 1.3e-3; s += 0.5e-6) {
      const HeightAndGradient a = evaluate_height(map, s, 0.7 * s);
      const HeightAndGradient b = evaluate_height(map, s + kStep_m, 0.7 * s + 0.7 * kStep_m);
      EXPECT_NEAR(b.height_m - a.height_m, kStep_m * (a.slope_x + 0.7 * a.slope_y), 1e-12) << s;
      EXPECT_NEAR(a.slope_x, b.slope_x, 1e-3) << s;
      EXPECT_NEAR(a.slope_y, b.slope_y, 1e-3) << s;
    }
  }
  const HeightMap map = map_of(12, 9, Border::kClamp);
  EXPECT_TRUE(std::isnan(evaluate_height(map, std::numeric_limits<double>::infinity(), 0.0).height_m));
  EXPECT_TRUE(std::isfinite(evaluate_height(map, 1e200, -1e200).height_m));
}

TEST(EvaluateHeightMap, LowestIsBelowAFineGrid) {
  const HeightMap map = map_of(12, 9, Border::kPeriodic);
  double lowest = 1.0;
  for (double x = 0.0; x < 0.48e-3; x += 1e-6) {
    for (double y = 0.0; y < 0.45e-3; y += 1e-6) lowest = std::min(lowest, evaluate_height(map, x, y).height_m);
  }
  EXPECT_NEAR(lowest_height_m(map), lowest, 1e-8);
}

Fourier1d waves() {
  Fourier1d f{7.3, std::vector<double>(20, 0.0), std::vector<double>(20, 0.0), 1e-5};
  f.a_m[2] = 8e-5;
  f.b_m[6] = 3e-5;
  f.a_m[19] = 1e-5;
  return f;
}

TEST(MakeHeightMap, TilesHaveNoStepInHeightOrSlope) {
  FitFourier2dConfig pattern;
  pattern.kind = Fourier2dFitKind::kPattern;
  // A period of 7.3 mm cut to a tile of 10 mm: the seam must be closed.
  const TextureModel source = fit_fourier2d(waves(), waves(), pattern).texture;
  MakeHeightMapConfig config;
  config.length_mm = 10.0;
  const HeightMapFit fit = make_height_map(source, config);
  EXPECT_EQ(fit.texture.columns, 256u);
  // Across the seam, heights differ no more than anywhere else inside: second differences stay of one size.
  const auto level = [&](std::size_t r, std::size_t c) {
    return fit.texture.metres_per_level() * static_cast<double>(fit.texture.level[(r % 256) * 256 + c % 256]);
  };
  double inside = 0.0;
  double seam = 0.0;
  for (std::size_t r = 0; r < 256; ++r) {
    for (std::size_t c = 0; c < 256; ++c) {
      const double bend = std::abs(level(r, c) - 2 * level(r, c + 1) + level(r, c + 2));
      (c >= 253 ? seam : inside) = std::max(c >= 253 ? seam : inside, bend);
      const double bend_y = std::abs(level(c, r) - 2 * level(c + 1, r) + level(c + 2, r));
      (c >= 253 ? seam : inside) = std::max(c >= 253 ? seam : inside, bend_y);
    }
  }
  EXPECT_LT(seam, 1.5 * inside);
  for (double y = 0.0; y < 0.01; y += 1.7e-4) {
    const HeightAndGradient before = evaluate_height(fit.texture, 0.01 - 1e-10, y);
    const HeightAndGradient after = evaluate_height(fit.texture, 0.01 + 1e-10, y);
    EXPECT_NEAR(after.height_m - before.height_m, 2e-10 * before.slope_x, 1e-15);
    EXPECT_NEAR(before.slope_x, after.slope_x, 1e-5);
    EXPECT_NEAR(before.slope_y, after.slope_y, 1e-5);
  }
  // Outside the blend the tile is its source, but for interpolation and half a level.
  EXPECT_LT(fit.rms_error_m, 0.01 * fit.rms_height_m);
}

TEST(MakeHeightMap, NeedsNoSeamWhereTheModelRepeats) {
  const TextureModel source = waves();
  MakeHeightMapConfig config;
  config.rows = 8;
  const HeightMapFit fit = make_height_map(source, config);
  EXPECT_DOUBLE_EQ(fit.texture.mm_per_px_x, 7.3 / 256);
  double worst = 0.0;
  for (std::size_t c = 0; c < 256; ++c) {
    const double x_m = 7.3e-3 * static_cast<double>(c) / 256;
    worst = std::max(
        worst, std::abs(evaluate_height(fit.texture, x_m, 0.0).height_m - evaluate_height(source, x_m, 0).height_m));
  }
  // Half a level of the range.
  EXPECT_LT(worst, 0.5000001 * fit.quantisation_m);
  EXPECT_NEAR(fit.quantisation_m, (fit.texture.high_m - fit.texture.low_m) / 65535, 1e-18);
}

TEST(MakeHeightMap, HasTheSeedsResolution) {
  MakeHeightMapConfig config;
  config.bits = 8;
  config.range_mm = 2.5;
  config.length_mm = 10.0;
  config.rows = 16;
  const HeightMapFit fit = make_height_map(TextureModel(waves()), config);
  EXPECT_NEAR(fit.quantisation_m, 2.5e-3 / 255, 1e-12);  // seed §6.5: about 0.01 mm
  EXPECT_EQ(fit.clipped, 0u);
  config.range_mm = 0.05;
  EXPECT_GT(make_height_map(TextureModel(waves()), config).clipped, 0u);
  config.bits = 12;
  EXPECT_THAT([&] { make_height_map(TextureModel(waves()), config); }, ThrowsMessage<Error>(HasSubstr("bits = 12")));
}

}  // namespace
}  // namespace asperity
