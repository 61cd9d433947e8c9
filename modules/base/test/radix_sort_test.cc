#include "asperity/base/radix_sort.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

// Against the standard library's, on both sides of the length from which digits are counted.
TEST(RadixSort, IsTheOrder) {
  Random random(3);
  for (const std::size_t n : {0u, 1u, 2u, 1999u, 2000u, 30000u}) {
    std::vector<std::uint64_t> values(n);
    for (std::uint64_t& value : values) value = random.bits() >> (random.bits() % 64);
    std::vector<std::uint64_t> expected = values;
    std::sort(expected.begin(), expected.end());
    radix_sort(values);
    EXPECT_EQ(values, expected) << n;
  }
}

TEST(RadixSort, FallingNumbersOfAllSizesAndBothSigns) {
  Random random(4);
  for (const std::size_t n : {0u, 7u, 30000u}) {
    std::vector<double> values(n);
    for (double& value : values) value = random.normal() * std::pow(10.0, random.uniform(-300.0, 300.0));
    if (n > 6) {
      values[0] = std::numeric_limits<double>::infinity();
      values[1] = -values[0];
      values[2] = 0.0;
      values[3] = -0.0;
      values[4] = std::numeric_limits<double>::denorm_min();
      values[5] = -values[4];
      values[6] = values[n / 2];
    }
    std::vector<double> expected = values;
    std::sort(expected.begin(), expected.end(), std::greater<>{});
    sort_falling(values);
    EXPECT_EQ(values, expected) << n;  // −0 equals 0
  }
}

TEST(RadixSort, EqualNumbersStay) {
  std::vector<double> values(5000, 2.5);
  sort_falling(values);
  EXPECT_EQ(values, std::vector<double>(5000, 2.5));
}

}  // namespace
}  // namespace asperity
