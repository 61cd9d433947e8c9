#include "asperity/device/snapshot_exchange.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

std::atomic<int> alive{0};

// Torn if its numbers differ; counts how many exist.
struct Snapshot {
  explicit Snapshot(std::uint64_t value) : numbers{} {
    numbers.fill(value);
    ++alive;
  }
  ~Snapshot() {
    numbers.fill(0);
    --alive;
  }
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;
  bool whole() const {
    for (const std::uint64_t n : numbers) {
      if (n != numbers[0]) return false;
    }
    return numbers[0] > 0;
  }
  std::array<std::uint64_t, 64> numbers;
};

// Spends some time, so that either side may be the faster one.
void idle(int turns) {
  std::atomic<int> turn{0};
  while (turn < turns) ++turn;
}

void run(int publishers, int publisher_idle, int reader_idle) {
  constexpr std::uint64_t kEach = 3000;
  {
    SnapshotExchange<const Snapshot> exchange(std::make_unique<const Snapshot>(1));
    std::atomic<int> running{publishers};
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(publishers));
    for (int p = 0; p < publishers; ++p) {
      threads.emplace_back([&] {
        for (std::uint64_t k = 2; k < kEach; ++k) {
          exchange.publish(std::make_unique<const Snapshot>(k));
          idle(publisher_idle);
        }
        --running;
      });
    }
    std::uint64_t last = 0;
    bool whole = true, rising = true;
    while (running > 0) {
      const Snapshot* const seen = exchange.acquire();
      whole = whole && seen->whole();
      rising = rising && seen->numbers[0] >= last;
      last = seen->numbers[0];
      idle(reader_idle);
      whole = whole && seen->whole();  // it stays until the next acquire()
    }
    for (std::thread& t : threads) t.join();
    EXPECT_TRUE(whole);
    if (publishers == 1) {
      EXPECT_TRUE(rising);
      EXPECT_EQ(exchange.acquire()->numbers[0], kEach - 1);
    }
    // The reader's, and at most one put aside and one published.
    EXPECT_LE(alive, 3);
  }
  EXPECT_EQ(alive, 0);
}

TEST(SnapshotExchange, PublisherFaster) { run(1, 0, 2000); }
TEST(SnapshotExchange, PublisherSlower) { run(1, 2000, 0); }
TEST(SnapshotExchange, SeveralPublishers) { run(3, 100, 100); }

TEST(SnapshotExchange, ReaderSeesWhatWasPublishedBeforeItsAcquire) {
  SnapshotExchange<const Snapshot> exchange(std::make_unique<const Snapshot>(1));
  EXPECT_EQ(exchange.acquire()->numbers[0], 1U);
  for (std::uint64_t k = 2; k < 10; ++k) {
    exchange.publish(std::make_unique<const Snapshot>(k + 100));
    exchange.publish(std::make_unique<const Snapshot>(k));
    EXPECT_EQ(exchange.acquire()->numbers[0], k);
    EXPECT_EQ(exchange.acquire()->numbers[0], k);
  }
}

// What was published before an acquire() began is seen by it, whatever the two threads do to each other in between.
TEST(SnapshotExchange, NoPublishIsLost) {
  constexpr std::uint64_t kPublishes = 300'000;
  SnapshotExchange<const std::uint64_t> exchange(std::make_unique<const std::uint64_t>(1));
  std::atomic<std::uint64_t> published{1};
  std::uint64_t lost = 0;
  std::thread reader([&] {
    for (std::uint64_t before = 1; before < kPublishes;) {
      before = published;
      if (*exchange.acquire() < before) ++lost;
    }
  });
  // Several at once, so that whole publishes fit into one acquire(), then none for some acquires.
  for (std::uint64_t k = 2; k <= kPublishes; ++k) {
    exchange.publish(std::make_unique<const std::uint64_t>(k));
    published = k;
    if (k % 3 == 0) idle(100);
  }
  reader.join();
  EXPECT_EQ(lost, 0U);
  EXPECT_EQ(*exchange.acquire(), kPublishes);
}

TEST(SnapshotExchange, RefusesNone) {
  EXPECT_THROW(SnapshotExchange<const Snapshot>(nullptr), Error);
  SnapshotExchange<const Snapshot> exchange(std::make_unique<const Snapshot>(1));
  EXPECT_THROW(exchange.publish(nullptr), Error);
  EXPECT_EQ(exchange.acquire()->numbers[0], 1U);
}

}  // namespace
}  // namespace asperity
