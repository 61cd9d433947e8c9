#include "asperity/device/duration_histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

TEST(DurationHistogram, EmptyIsZero) {
  const DurationHistogram h;
  EXPECT_EQ(h.count(), 0U);
  EXPECT_EQ(h.percentile_ns(0.5), 0);
  EXPECT_EQ(h.max_ns(), 0);
}

TEST(DurationHistogram, SmallDurationsAreExact) {
  DurationHistogram h;
  for (int k = 0; k <= 40; ++k) h.add(k);
  h.add(-5);
  EXPECT_EQ(h.count(), 42U);
  EXPECT_EQ(h.percentile_ns(0.0), 0);
  EXPECT_EQ(h.percentile_ns(0.5), 19);  // the 21st of 0, 0, 1, 2, …
  EXPECT_EQ(h.percentile_ns(1.0), 40);
}

TEST(DurationHistogram, PercentilesOfManyAgreeWithSorting) {
  Random random(7);
  DurationHistogram h;
  std::vector<std::int64_t> all;
  for (int k = 0; k < 20'000; ++k) {
    all.push_back(static_cast<std::int64_t>(std::exp(random.uniform(0.0, 25.0))));
    h.add(all.back());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(h.max_ns(), all.back());
  for (const double fraction : {0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const std::int64_t exact = all[static_cast<std::size_t>(std::ceil(fraction * 20'000.0)) - 1];
    EXPECT_GE(h.percentile_ns(fraction), exact);
    EXPECT_LE(h.percentile_ns(fraction), exact + exact / 32 + 1) << fraction;  // the width of a bin
  }
}

TEST(DurationHistogram, TakesTheLargestNumber) {
  DurationHistogram h;
  h.add(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(h.percentile_ns(0.5), std::numeric_limits<std::int64_t>::max());
}

}  // namespace
}  // namespace asperity
