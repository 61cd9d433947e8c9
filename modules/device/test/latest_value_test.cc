#include "asperity/device/latest_value.h"

#include <array>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace asperity {

TEST(LatestValue, GivesTheNewestAndKeepsIt) {
  LatestValue<int> value(7);
  EXPECT_EQ(value.take(), 7);
  value.publish(1);
  value.publish(2);
  EXPECT_EQ(value.take(), 2);
  EXPECT_EQ(value.take(), 2);
  value.publish(3);
  EXPECT_EQ(value.take(), 3);
}

TEST(LatestValue, TellsWhetherThereIsNews) {
  LatestValue<int> value;
  int got = 7;
  EXPECT_FALSE(value.take_if_new(got));
  EXPECT_EQ(got, 7);
  value.publish(1);
  value.publish(2);
  EXPECT_TRUE(value.take_if_new(got));
  EXPECT_EQ(got, 2);
  EXPECT_FALSE(value.take_if_new(got));
}

TEST(LatestValue, NeverTearsAndNeverGoesBack) {
  using Wide = std::array<std::uint64_t, 16>;
  LatestValue<Wide> value(Wide{});
  constexpr std::uint64_t kCount = 200'000;
  std::thread writer([&] {
    Wide wide;
    for (std::uint64_t i = 1; i <= kCount; ++i) {
      wide.fill(i);
      value.publish(wide);
    }
  });
  std::uint64_t before = 0;
  bool whole = true;
  while (before < kCount) {
    const Wide& wide = value.take();
    for (const std::uint64_t word : wide) whole = whole && word == wide[0];
    whole = whole && wide[0] >= before;
    before = wide[0];
  }
  writer.join();
  EXPECT_TRUE(whole);
}

}  // namespace asperity
