#include "asperity/base/little_endian.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace asperity {
namespace {

TEST(LittleEndian, NumbersAreAppendedWithTheLowestByteFirst) {
  std::string text;
  append_little_endian<std::uint16_t>(text, 0x6261);
  append_little_endian(text, std::int32_t{-2});
  EXPECT_EQ(text, "ab\xFE\xFF\xFF\xFF");
  std::vector<std::uint8_t> bytes;
  append_little_endian(bytes, 1.0);  // 3FF0000000000000h
  EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0xF0, 0x3F}));
}

TEST(LittleEndian, NumbersAreLoadedInEitherOrder) {
  constexpr char kBytes[] = {1, 2, 3, 4};
  EXPECT_EQ(load_number<std::uint32_t>(kBytes, std::endian::little), 0x04030201U);
  EXPECT_EQ(load_number<std::uint32_t>(kBytes, std::endian::big), 0x01020304U);
}

TEST(LittleEndian, NumbersAreTakenOneAfterAnother) {
  const std::vector<std::uint8_t> bytes{0xFF, 0x34, 0x12, 0xFE, 0xFF};
  std::size_t at = 1;
  EXPECT_EQ(take_little_endian<std::uint16_t>(bytes, at), 0x1234);
  EXPECT_EQ(take_little_endian<std::int16_t>(bytes, at), -2);
  EXPECT_EQ(at, 5U);
}

}  // namespace
}  // namespace asperity
