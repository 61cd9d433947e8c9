#include <gmock/gmock.h>
#include <algorithm>
#include <string_view>

#include "asperity/base/random.h"
#include "asperity/link/cobs.h"

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

}  // namespace
}  // namespace asperity
