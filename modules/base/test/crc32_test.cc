#include "asperity/base/crc32.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {
namespace {

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
  constexpr std::string_view digits = "123456789";
  EXPECT_EQ(crc32(digits), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
  EXPECT_EQ(crc32(std::span<const std::uint8_t>()), 0U);
  Random random(2);
  for (std::size_t size = 1; size < 100; ++size) {
    std::vector<std::uint8_t> bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.bits() >> 56);
    EXPECT_EQ(crc32(bytes), crc_by_bits(bytes));
  }
}

}  // namespace
}  // namespace asperity
