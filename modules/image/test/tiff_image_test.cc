// TIFF files made byte by byte by the specification (TIFF 6.0), not by libtiff.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/image/tiff_image.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

enum class Order { kLittle, kBig };

struct Kind {
  int bits;
  int format;  // 1 unsigned, 2 signed, 3 float
};

class TiffMaker {
 public:
  TiffMaker(Order order, Kind kind, std::size_t columns, std::size_t rows)
      : order_(order), kind_(kind), columns_(columns), rows_(rows) {}

  int samples = 1;
  int photometric = 1;
  std::size_t tile = 0;  // side of a tile, of at least 16; 0: one strip
  int copies = 0;        // further directories, of the same strip
  int copy_kind = 0;     // NewSubfileType of these

  std::string make(const std::vector<double>& values) const {
    std::string pixels;
    std::vector<std::size_t> parts;  // where each strip or tile begins
    if (tile == 0) {
      parts.push_back(0);
      for (const double value : values) put_value(pixels, value);
    } else {
      for (std::size_t row = 0; row < rows_; row += tile)
        for (std::size_t column = 0; column < columns_; column += tile) {
          parts.push_back(pixels.size());
          for (std::size_t r = row; r < row + tile; ++r)
            for (std::size_t c = column; c < column + tile; ++c)
              put_value(pixels, r < rows_ && c < columns_ ? values[r * columns_ + c] : 0.0);
        }
    }
    const std::size_t part_bytes = pixels.size() / parts.size();
    std::vector<std::array<std::size_t, 3>> fields{{256, 4, columns_},
                                                   {257, 4, rows_},
                                                   {258, 3, static_cast<std::size_t>(kind_.bits)},
                                                   {259, 3, 1},
                                                   {262, 3, static_cast<std::size_t>(photometric)},
                                                   {277, 3, static_cast<std::size_t>(samples)},
                                                   {339, 3, static_cast<std::size_t>(kind_.format)}};
    if (tile == 0) {
      fields.push_back({278, 4, rows_});
    } else {
      fields.push_back({322, 4, tile});
      fields.push_back({323, 4, tile});
    }
    if (copies > 0) fields.push_back({254, 4, 0});
    const std::size_t count = fields.size() + 2;
    const std::size_t directory = 2 + 12 * count + 4;
    const std::size_t lists = 8 + directory * static_cast<std::size_t>(1 + copies);
    const std::size_t begin = lists + (parts.size() > 1 ? 8 * parts.size() : 0);
    const std::size_t offsets_tag = tile == 0 ? 273 : 324, bytes_tag = tile == 0 ? 279 : 325;
    std::map<std::size_t, std::string> entries;
    for (const auto& [tag, type, value] : fields) entries[tag] = entry(tag, type, 1, value);
    const bool one = parts.size() == 1;
    entries[offsets_tag] = entry(offsets_tag, 4, parts.size(), one ? begin : lists);
    entries[bytes_tag] = entry(bytes_tag, 4, parts.size(), one ? part_bytes : lists + 4 * parts.size());
    std::string out = order_ == Order::kLittle ? std::string("II*\0", 4) : std::string("MM\0*", 4);
    put(out, 8, 4);
    put(out, count, 2);
    for (int i = 0; i <= copies; ++i) {
      if (i > 0) {
        put(out, count, 2);
        entries[254] = entry(254, 4, 1, static_cast<std::size_t>(copy_kind));
      }
      for (const auto& [tag, bytes] : entries) out += bytes;
      put(out, i < copies ? 8 + directory * static_cast<std::size_t>(1 + i) : 0, 4);
    }
    if (!one) {
      for (const std::size_t part : parts) put(out, begin + part, 4);
      for (std::size_t i = 0; i < parts.size(); ++i) put(out, part_bytes, 4);
    }
    return out + pixels;
  }

 private:
  void put(std::string& out, std::uint64_t value, int bytes) const {
    for (int i = 0; i < bytes; ++i) {
      const int shift = 8 * (order_ == Order::kLittle ? i : bytes - 1 - i);
      out += static_cast<char>(value >> shift & 0xFF);
    }
  }
  void put_value(std::string& out, double value) const {
    if (kind_.format == 3 && kind_.bits == 32)
      return put(out, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
    if (kind_.format == 3) return put(out, std::bit_cast<std::uint64_t>(value), 8);
    put(out, static_cast<std::uint64_t>(static_cast<std::int64_t>(value)), kind_.bits / 8);
  }
  std::string entry(std::size_t tag, std::size_t type, std::size_t count, std::size_t value) const {
    std::string out;
    put(out, tag, 2);
    put(out, type, 2);
    put(out, count, 4);
    put(out, value, type == 3 ? 2 : 4);
    if (type == 3) put(out, 0, 2);
    return out;
  }

  Order order_;
  Kind kind_;
  std::size_t columns_, rows_;
};

// 20 x 18 numbers that the kind can hold.
std::vector<double> numbers(Kind kind) {
  std::vector<double> out;
  for (int i = 0; i < 360; ++i) {
    if (kind.format == 3) {
      out.push_back(0.25 * i - 7.5);
    } else {
      const double high = std::ldexp(1.0, kind.bits - (kind.format == 2 ? 1 : 0)) - 1.0;
      out.push_back(kind.format == 2 ? std::floor(-high + 2.0 * high * i / 359.0) : std::floor(high * i / 359.0));
    }
  }
  return out;
}

TEST(TiffImage, AllKindsAndBothOrdersAreReadAsStored) {
  for (const Order order : {Order::kLittle, Order::kBig}) {
    for (const Kind kind :
         {Kind{8, 1}, Kind{8, 2}, Kind{16, 1}, Kind{16, 2}, Kind{32, 1}, Kind{32, 2}, Kind{32, 3}, Kind{64, 3}}) {
      for (const std::size_t tile : {std::size_t{0}, std::size_t{16}}) {
        TiffMaker maker(order, kind, 20, 18);
        maker.tile = tile;
        const std::vector<double> values = numbers(kind);
        const TiffImage image = parse_tiff(maker.make(values), "t.tif");
        ASSERT_EQ(image.columns, 20u);
        ASSERT_EQ(image.rows, 18u);
        EXPECT_EQ(image.bits, kind.bits);
        EXPECT_EQ(image.is_float, kind.format == 3);
        EXPECT_EQ(image.values, values) << kind.bits << " bits of kind " << kind.format << ", tiles of " << tile;
      }
    }
  }
}

// 4 x 4 floats 0.5 i - 1.25 with Deflate, by Python's zlib.
constexpr const char* kDeflated =
    "49492a00080000000a0000010400010000000400000001010400010000000400000002010300010000002000000003010300010000000800"
    "0000060103000100000001000000110104000100000086000000150103000100000001000000160104000100000004000000170104000100"
    "0000370000005301030001000000030000000000000078da636058b09f81c101881bf601b11d906dcfc0b000881f00b18003038301100700"
    "7101107700f10c205e01c43b80f8840300b8220d60";

TEST(TiffImage, DeflateIsRead) {
  std::string bytes;
  const std::string hex = kDeflated;
  for (std::size_t i = 0; i < hex.size(); i += 2) bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  const TiffImage image = parse_tiff(bytes, "deflated.tif");
  ASSERT_EQ(image.values.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(image.values[i], 0.5 * static_cast<double>(i) - 1.25);
}

TEST(TiffImage, MissingFloatsStayMissing) {
  std::vector<double> values = numbers({32, 3});
  values[7] = std::nan("");
  EXPECT_TRUE(std::isnan(parse_tiff(TiffMaker(Order::kLittle, {32, 3}, 20, 18).make(values), "t.tif").values[7]));
  values[7] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(
      [&] {
        parse_tiff(TiffMaker(Order::kLittle, {32, 3}, 20, 18).make(values), "t.tif");
      },
      ThrowsMessage<Error>(HasSubstr("pixel 8 of row 1")));
}

TEST(TiffImage, NamesWhatIsNotRead) {
  const std::vector<double> values = numbers({16, 1});
  TiffMaker colours(Order::kLittle, {16, 1}, 20, 6);
  colours.samples = 3;
  EXPECT_THAT([&] { parse_tiff(colours.make(values), "t.tif"); }, ThrowsMessage<Error>(HasSubstr("3 numbers a pixel")));
  TiffMaker inverted(Order::kLittle, {16, 1}, 20, 18);
  inverted.photometric = 0;
  EXPECT_THAT([&] { parse_tiff(inverted.make(values), "t.tif"); }, ThrowsMessage<Error>(HasSubstr("of kind 0")));
  EXPECT_THAT(
      [&] {
        parse_tiff(TiffMaker(Order::kLittle, {16, 1}, 0, 18).make(values), "t.tif");
      },
      ThrowsMessage<Error>(HasSubstr("t.tif: ")));
  EXPECT_THAT(
      [&] {
        parse_tiff(TiffMaker(Order::kLittle, {16, 1}, 2000000, 2000000).make(values), "t.tif");
      },
      ThrowsMessage<Error>(HasSubstr("too large")));
  EXPECT_THAT(
      [&] {
        parse_tiff(TiffMaker(Order::kLittle, {16, 1}, 10000, 10000).make(values), "t.tif");
      },
      ThrowsMessage<Error>(HasSubstr("do not fit")));
  EXPECT_THROW(parse_tiff("GIF89a", "t.tif"), Error);
}

TEST(TiffImage, FurtherPagesAreRefusedSmallerCopiesNot) {
  const std::vector<double> values = numbers({16, 1});
  TiffMaker pages(Order::kLittle, {16, 1}, 20, 18);
  pages.copies = 1;
  EXPECT_THAT([&] { parse_tiff(pages.make(values), "t.tif"); }, ThrowsMessage<Error>(HasSubstr("has further pages")));
  pages.copies = 2;
  pages.copy_kind = 1;  // a reduced copy
  EXPECT_EQ(parse_tiff(pages.make(values), "t.tif").values, values);
}

TEST(TiffImage, IsNotReadCut) {
  const std::string whole = TiffMaker(Order::kLittle, {16, 1}, 20, 18).make(numbers({16, 1}));
  for (std::size_t size = 4; size < whole.size(); size += size < 160 ? 1 : 37)
    EXPECT_THROW(parse_tiff(whole.substr(0, size), "cut.tif"), Error) << size;
}

}  // namespace
}  // namespace asperity
