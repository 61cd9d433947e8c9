#include "asperity/device/spsc_ring.h"

#include <array>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using Item = std::array<std::uint64_t, 16>;

TEST(SpscRing, RefusesWhenFullAndKeepsOrder) {
  SpscRing<int> ring(3);
  ASSERT_EQ(ring.capacity(), 4U);
  for (int round = 0; round < 5; ++round) {
    for (int k = 0; k < 4; ++k) EXPECT_TRUE(ring.push(k));
    EXPECT_FALSE(ring.push(99));
    int item = -1;
    for (int k = 0; k < 4; ++k) {
      ASSERT_TRUE(ring.pop(item));
      EXPECT_EQ(item, k);
    }
    EXPECT_FALSE(ring.pop(item));
  }
}

TEST(SpscRing, PassesEveryItemWholeBetweenThreads) {
  constexpr std::uint64_t kItems = 100'000;
  SpscRing<Item> ring(64);
  std::thread producer([&] {
    for (std::uint64_t k = 0; k < kItems;) {
      Item item;
      item.fill(k);
      if (ring.push(item)) {
        ++k;
      } else {
        std::this_thread::yield();
      }
    }
  });
  bool right = true;
  for (std::uint64_t k = 0; k < kItems;) {
    Item item{};
    if (!ring.pop(item)) {
      std::this_thread::yield();
      continue;
    }
    for (const std::uint64_t n : item) right = right && n == k;
    ++k;
  }
  producer.join();
  EXPECT_TRUE(right);
}

}  // namespace
}  // namespace asperity
