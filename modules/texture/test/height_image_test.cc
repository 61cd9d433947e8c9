// Grey-scale images as height maps: both kinds of file, and damaged ones.
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/image/pgm_image.h"
#include "asperity/image/png_image.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/read_height_image.h"

namespace asperity {
namespace {

DeepGrayImage ramp(int bits) {
  DeepGrayImage image{8, 4, {}, bits};
  for (std::uint16_t i = 0; i < 32; ++i) image.pixels.push_back(static_cast<std::uint16_t>(bits == 8 ? i : 100 * i));
  return image;
}

std::string pgm(const DeepGrayImage& image) {
  std::string out = "P5\n# a comment\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n" +
                    (image.bits == 8 ? "255" : "65535") + "\n";
  for (const std::uint16_t level : image.pixels) {
    if (image.bits == 16) out += static_cast<char>(level >> 8);
    out += static_cast<char>(level & 255);
  }
  return out;
}

TEST(HeightImage, PgmAndPngOfOneImageAreTheSame) {
  for (const int bits : {8, 16}) {
    const DeepGrayImage image = ramp(bits);
    const DeepGrayImage read = parse_pgm(pgm(image), "test");
    EXPECT_EQ(read.pixels, image.pixels);
    EXPECT_EQ(read.bits, bits);
    EXPECT_EQ(read.width, 8);
    const auto a = std::get<HeightMap>(parse_height_image(pgm(image), "a").model);
    const auto b = std::get<HeightMap>(parse_height_image(format_png(image), "b").model);
    EXPECT_EQ(a.level, b.level);
  }
}

TEST(HeightImage, TextIsReadAndOtherMaximaAreScaled) {
  const DeepGrayImage image = parse_pgm("P2 2 2 15\n0 15 # white\n1 8\n", "test");
  EXPECT_EQ(image.pixels, (std::vector<std::uint16_t>{0, 255, 17, 136}));
}

// Fig. 38: 256 levels over 2.5 mm, 10 mm wide.
TEST(HeightImage, HasTheSizeAndRangeAskedFor) {
  DeepGrayImage image{256, 256, std::vector<std::uint16_t>(256 * 256, 51), 8};
  const Texture texture = parse_height_image(format_png(image), "test");
  EXPECT_NEAR(evaluate_height(texture.model, 3e-3, 4e-3).height_m, 0.5e-3, 1e-12);
  EXPECT_DOUBLE_EQ(std::get<HeightMap>(texture.model).mm_per_px_x, 10.0 / 256);
  EXPECT_NEAR(std::get<HeightMap>(texture.model).metres_per_level(), 2.5e-3 / 255, 1e-15);
}

// 4 x 4 pixels whose level is (row + column) mod 4 of 3, as zlib and the PNG specification make them, not libpng.
constexpr const char* kTwoBits =
    "89504e470d0a1a0a0000000d4948445200000004000000040200000000c62ad903000000104944415478da639066c861d8c8700c0005ba01ff"
    "519cd7cc0000000049454e44ae426082";
constexpr const char* kPalette =
    "89504e470d0a1a0a0000000d4948445200000004000000040203000000d49f76ed0000000c504c5445000000555555aaaaaaffffffc17f62d1"
    "000000104944415478da639066c861d8c8700c0005ba01ff519cd7cc0000000049454e44ae426082";
constexpr const char* kAlpha =
    "89504e470d0a1a0a0000000d494844520000000400000004080400000003f856f50000001e4944415478da6360e00ae55ac5f59f8b014a7131"
    "40a8502e0608b58a0b009e800899830837530000000049454e44ae426082";
constexpr const char* kColours16 =
    "89504e470d0a1a0a0000000d49484452000000040000000410020000007603d56a000000204944415478da636000835030580506ffc1009b10"
    "04600a419432600a41940200578b2fd1d2c0902e0000000049454e44ae426082";

std::string bytes_of(const std::string& hex) {
  std::string out;
  for (std::size_t i = 0; i < hex.size(); i += 2) out += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return out;
}

TEST(HeightImage, OtherImagesAreConvertedAndSaidSo) {
  struct Case {
    const char* hex;
    int bits;
    const char* note;
  };
  for (const Case& one : {Case{kTwoBits, 8, "2 bits"}, Case{kPalette, 8, "a palette"},
                          Case{kAlpha, 8, "transparency, which is left out"}, Case{kColours16, 16, "colours"}}) {
    Problems problems;
    const auto map = std::get<HeightMap>(parse_height_image(bytes_of(one.hex), "image.png", {}, &problems).model);
    EXPECT_EQ(map.bits, one.bits) << one.note;
    const int step = one.bits == 8 ? 85 : 21845;
    ASSERT_EQ(map.level.size(), 16u);
    for (std::size_t i = 0; i < 16; ++i)
      EXPECT_EQ(map.level[i], step * static_cast<int>((i / 4 + i % 4) % 4)) << one.note << ' ' << i;
    ASSERT_EQ(problems.size(), 1u) << one.note;
    EXPECT_EQ(problems[0].kind, "converted_image");
    EXPECT_NE(problems[0].message.find(one.note), std::string::npos) << problems[0].message;
  }
  Problems none;
  parse_height_image(format_png(ramp(16)), "plain.png", {}, &none);
  EXPECT_TRUE(none.empty());
}

TEST(HeightImage, RefusesDamage) {
  const std::string good = pgm(ramp(8));
  for (std::size_t cut = 0; cut < good.size(); ++cut)
    EXPECT_THROW(parse_pgm(good.substr(0, cut), "test"), Error) << cut;
  EXPECT_THROW(parse_pgm(good + "x", "test"), Error);
  EXPECT_THROW(parse_pgm("P2 2 2 15 0 16 1 8", "test"), Error);
  EXPECT_THROW(parse_pgm("P2 2 2 15 0 1 1", "test"), Error);
  EXPECT_THROW(parse_pgm("P5 99999999999999999999 2 255 ", "test"), Error);
  EXPECT_THROW(parse_pgm("P5 8192 8192 65535 ", "test"), Error);
  EXPECT_THROW(parse_pgm("P6 1 1 255 abc", "test"), Error);
  EXPECT_THROW(parse_height_image("P2 2 2 255 0 0 0 0", "small"), Error);
  ReadHeightImageConfig config;
  config.width_mm = 0.0;
  EXPECT_THROW(parse_height_image(good, "test", config), Error);
}

}  // namespace
}  // namespace asperity
