#include <gmock/gmock.h>
#include <algorithm>
#include <string_view>

#include "asperity/base/random.h"
#include "asperity/link/cobs.h"
#include "asperity/link/crc32.h"

namespace asperity {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes encoded(const Bytes& data) {
  Bytes out;
  append_cobs(data, out);
  return out;
}

// Ascending bytes from `first`, `count` of them, none of them zero.
Bytes ascending(std::uint8_t first, std::size_t count) {
  Bytes out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<std::uint8_t>(first + i % 254);
  return out;
}

// The examples of Cheshire and Baker (1999) and of the article on COBS in Wikipedia.
TEST(Cobs, PublishedExamples) {
  EXPECT_EQ(encoded({}), Bytes({1}));
  EXPECT_EQ(encoded({0}), Bytes({1, 1}));
  EXPECT_EQ(encoded({0, 0}), Bytes({1, 1, 1}));
  EXPECT_EQ(encoded({0, 0x11, 0}), Bytes({1, 2, 0x11, 1}));
  EXPECT_EQ(encoded({0x11, 0x22, 0, 0x33}), Bytes({3, 0x11, 0x22, 2, 0x33}));
  EXPECT_EQ(encoded({0x11, 0, 0, 0}), Bytes({2, 0x11, 1, 1, 1}));

  Bytes full = ascending(1, 254);
  Bytes block = full;
  block.insert(block.begin(), 0xFF);
  EXPECT_EQ(encoded(full), block);

  full.insert(full.begin(), 0);
  block.insert(block.begin(), 1);
  EXPECT_EQ(encoded(full), block);
}

TEST(Cobs, RoundTripsHaveNoZeroAndStayInTheirBound) {
  Random random(1);
  for (int run = 0; run < 2000; ++run) {
    Bytes data(static_cast<std::size_t>(random.uniform(0.0, 1300.0)));
    const double zeros = random.uniform() * random.uniform();
    for (auto& byte : data) byte = random.chance(zeros) ? 0 : static_cast<std::uint8_t>(random.bits() >> 56);
    const Bytes block = encoded(data);
    EXPECT_EQ(std::count(block.begin(), block.end(), 0), 0);
    EXPECT_LE(block.size(), cobs_bound(data.size()));
    Bytes back(data.size());
    ASSERT_EQ(decode_cobs(block, back), data.size());
    EXPECT_EQ(back, data);
    if (!data.empty()) {
      Bytes tight(data.size() - 1);
      EXPECT_EQ(decode_cobs(block, tight), std::nullopt);
    }
  }
}

TEST(Cobs, BlocksThatAreNoneAreRefused) {
  Bytes room(600);
  EXPECT_EQ(decode_cobs(Bytes{}, room), std::nullopt);
  EXPECT_EQ(decode_cobs(Bytes{0}, room), std::nullopt);
  EXPECT_EQ(decode_cobs(Bytes{3, 7}, room), std::nullopt);
  EXPECT_EQ(decode_cobs(Bytes{2, 7, 0, 7}, room), std::nullopt);
  EXPECT_EQ(decode_cobs(Bytes(255, 0xFF), {}), std::nullopt);
}

// Bit by bit from the polynomial, as the document states it.
std::uint32_t crc_by_bits(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const std::uint8_t byte : bytes) {
    for (int bit = 0; bit < 8; ++bit) {
      const bool one = ((crc ^ static_cast<std::uint32_t>(byte >> bit)) & 1U) != 0;
      crc = (crc >> 1) ^ (one ? 0xEDB88320U : 0U);
    }
  }
  return ~crc;
}

TEST(Crc32, CheckValueAndTheDefinition) {
  const std::string_view digits = "123456789";
  EXPECT_EQ(crc32({reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()}), 0xCBF43926U);
  EXPECT_EQ(crc32({}), 0U);
  Random random(2);
  for (std::size_t size = 1; size < 100; ++size) {
    Bytes bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.bits() >> 56);
    EXPECT_EQ(crc32(bytes), crc_by_bits(bytes));
  }
}

}  // namespace
}  // namespace asperity
