#include "asperity/image/read_gray_image.h"

#include <gmock/gmock.h>
#include <algorithm>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/image/png_image.h"
#include "asperity/testkit/encode_jpeg.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Bytes = std::vector<unsigned char>;

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

GrayImage gradient(int width, int height) {
  GrayImage out{width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) out.pixels.push_back(static_cast<std::uint8_t>(3 * column + row));
  }
  return out;
}

Bytes encoded(const std::string& extension) {
  const GrayImage image = gradient(40, 30);
  if (extension == ".jpg") return testkit::encode_jpeg(40, 30, image.pixels);
  if (extension == ".png") return bytes_of(format_png(image));
  return bytes_of("P5\n40 30\n255\n" + std::string(image.pixels.begin(), image.pixels.end()));
}

TEST(ReadGrayImage, FormatsThatKeepEveryPixel) {
  const GrayImage truth = gradient(40, 30);
  for (const std::string extension : {".png", ".pgm"}) {
    const GrayImage image = decode_gray_image(encoded(extension), extension);
    ASSERT_EQ(image.width, 40);
    ASSERT_EQ(image.height, 30);
    EXPECT_EQ(image.pixels, truth.pixels);
  }
  const GrayImage jpeg = decode_gray_image(encoded(".jpg"), "jpeg");
  int worst = 0;
  for (int i = 0; i < 40 * 30; ++i)
    worst = std::max(worst, std::abs(jpeg.at(i % 40, i / 40) - truth.at(i % 40, i / 40)));
  EXPECT_LE(worst, 8);  // gray levels lost to quality 95
}

TEST(ReadGrayImage, DamagedImagesAreRefused) {
  for (const std::string extension : {".png", ".pgm", ".jpg"}) {
    const Bytes whole = encoded(extension);
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 50) {
      const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_THAT([&] { decode_gray_image(cut, "cut"); }, ThrowsMessage<Error>(testing::StartsWith("cut: ")))
          << extension << " cut to " << size;
    }
  }
}

TEST(ReadGrayImage, SizesAreBoundedBeforeDecoding) {
  const std::string pgm = "P5\n# a comment\n8193 1\n255\n" + std::string(8193, 'x');
  EXPECT_THAT([&] { decode_gray_image(bytes_of(pgm), "x.pgm"); },
              ThrowsMessage<Error>(testing::AllOf(HasSubstr("x.pgm: "), HasSubstr("8193 x 1"))));
  Bytes png = encoded(".png");
  png[16] = 0x7f;  // the width's highest byte
  EXPECT_THAT([&] { decode_gray_image(png, "x.png"); }, ThrowsMessage<Error>(HasSubstr("2130706472 x 30")));
  Bytes jpeg = encoded(".jpg");
  const Bytes frame = {0xff, 0xc0};
  const auto at = std::search(jpeg.begin(), jpeg.end(), frame.begin(), frame.end());
  ASSERT_NE(at, jpeg.end());
  at[5] = 0xff;  // the height
  EXPECT_THAT([&] { decode_gray_image(jpeg, "x.jpg"); }, ThrowsMessage<Error>(HasSubstr("40 x 65310")));
  EXPECT_THAT([&] { decode_gray_image(bytes_of("GIF89a"), "x.gif"); }, ThrowsMessage<Error>(HasSubstr("not an image")));
}

// 0.299 R + 0.587 G + 0.114 B; the upper 8 of 16 bits.
TEST(ReadGrayImage, ColoursAndDepth) {
  EXPECT_THAT(
      decode_gray_image(bytes_of("P6 4 1 255\n" + std::string("\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff", 12)), "x.ppm")
          .pixels,
      testing::ElementsAre(76, 150, 29, 255));
  EXPECT_THAT(decode_gray_image(bytes_of("P5 2 1 65535\n\x12\xff\xfe\x01"), "x.pgm").pixels,
              testing::ElementsAre(0x12, 0xfe));
  EXPECT_THAT(decode_gray_image(bytes_of(format_png(DeepGrayImage{2, 1, {0x12ff, 0xfe01}})), "x.png").pixels,
              testing::ElementsAre(0x12, 0xfe));
  // 2 x 1 pixels of 8 bit red and green, written with Python's zlib and struct alone.
  const Bytes colours = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
                         0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x7b,
                         0x40, 0xe8, 0xdd, 0x00, 0x00, 0x00, 0x0f, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0xf8,
                         0xcf, 0xc0, 0xc0, 0xf0, 0x9f, 0x01, 0x00, 0x07, 0xff, 0x01, 0xff, 0xb8, 0x04, 0x35, 0xe0,
                         0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  // libpng cuts off what is behind the point.
  EXPECT_THAT(decode_gray_image(colours, "x.png").pixels, testing::ElementsAre(76, 149));
}

TEST(ReadGrayImage, FramesOfMotionJpegWithoutTables) {
  Bytes frame = testkit::encode_jpeg(40, 30, gradient(40, 30).pixels, 50);
  const GrayImage whole = decode_gray_image(frame, "whole");
  // The segments DHT, FF C4, hold the tables of the standard, which a camera leaves out.
  for (std::size_t at = 2; at + 4 <= frame.size() && frame[at + 1] != 0xda;) {
    const std::size_t length = 2u + (static_cast<std::size_t>(frame[at + 2]) << 8 | frame[at + 3]);
    const auto begin = frame.begin() + static_cast<std::ptrdiff_t>(at);
    if (frame[at + 1] == 0xc4) {
      frame.erase(begin, begin + static_cast<std::ptrdiff_t>(length));
    } else {
      at += length;
    }
  }
  EXPECT_EQ(decode_gray_image(frame, "frame").pixels, whole.pixels);
}

TEST(FormatPng, ACamerasImageComesBack) {
  const GrayImage image = gradient(41, 7);
  EXPECT_EQ(decode_png(format_png(image), "x.png").pixels, image.pixels);
  EXPECT_THROW(format_png(GrayImage{3, 3, {1, 2}}), Error);
  EXPECT_THROW(format_png(GrayImage{}), Error);
}

}  // namespace
}  // namespace asperity
