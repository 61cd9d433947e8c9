#include "spsc_queue.h"

#include <array>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using Item = std::array<std::uint64_t, 16>;

TEST(SpscQueue, RefusesWhenFullAndKeepsOrder) {
  SpscQueue<int> queue(4);
  EXPECT_EQ(queue.read_available(), 0U);
  for (int round = 0; round < 5; ++round) {
    for (int k = 0; k < 4; ++k) EXPECT_TRUE(queue.push(k));
    EXPECT_FALSE(queue.push(99));
    int item = -1;
    for (int k = 0; k < 4; ++k) {
      ASSERT_TRUE(queue.pop(item));
      EXPECT_EQ(item, k);
    }
    EXPECT_FALSE(queue.pop(item));
  }
}

TEST(SpscQueue, PassesEveryItemWholeBetweenThreads) {
  constexpr std::uint64_t kItems = 100'000;
  SpscQueue<Item> queue(64);
  std::thread producer([&] {
    for (std::uint64_t k = 0; k < kItems;) {
      Item item;
      item.fill(k);
      if (queue.push(item)) {
        ++k;
      } else {
        std::this_thread::yield();
      }
    }
  });
  bool right = true;
  for (std::uint64_t k = 0; k < kItems;) {
    Item item{};
    if (!queue.pop(item)) {
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
