#include "../src/latest_value.h"

#include <gtest/gtest.h>
#include <thread>

#include "asperity/testkit/count_allocations.h"

namespace asperity {
namespace {

TEST(LatestValue, GivesTheNewestOnce) {
  LatestValue<int> value;
  int got = 7;
  EXPECT_FALSE(value.read(got));
  EXPECT_EQ(got, 7);
  value.write(1);
  value.write(2);
  EXPECT_TRUE(value.read(got));
  EXPECT_EQ(got, 2);
  EXPECT_FALSE(value.read(got));
  value.write(3);
  EXPECT_TRUE(value.read(got));
  EXPECT_EQ(got, 3);
}

TEST(LatestValue, IsNeverTornNorGoesBackAndDoesNotAllocate) {
  struct Wide {
    std::uint64_t a[8];
  };
  constexpr std::uint64_t kWrites = 300000;
  LatestValue<Wide> value;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kWrites; ++i) value.write({{i, i, i, i, i, i, i, i}});
  });
  const std::size_t before = testkit::count_allocations();
  Wide got{};
  std::uint64_t last = 0, torn = 0, back = 0;
  while (last < kWrites) {
    if (!value.read(got)) continue;
    for (const std::uint64_t part : got.a) torn += part != got.a[0];
    back += got.a[0] <= last;
    last = got.a[0];
  }
  EXPECT_EQ(testkit::count_allocations(), before);
  writer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(back, 0U);
}

}  // namespace
}  // namespace asperity
