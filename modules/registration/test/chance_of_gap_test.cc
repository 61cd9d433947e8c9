#include "asperity/registration/chance_of_gap.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

// The chance that was stated, of the largest of `count` draws.
double stated(std::size_t count, Random& random, const std::function<double(Random&)>& draw) {
  std::vector<double> values(count);
  for (double& value : values) value = draw(random);
  std::iter_swap(values.begin(), std::max_element(values.begin(), values.end()));
  return chance_of_gap(values.front(), {values.begin() + 1, values.end()});
}

TEST(ChanceOfGap, IsUniformForExponentialTailsOfAnyScale) {
  Random random(11);
  constexpr int kDraws = 20000;
  int below_tenth = 0, below_hundredth = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double scale = std::exp(random.normal());
    const double p = stated(25, random, [&](Random& r) { return -scale * std::log(1.0 - r.uniform()); });
    below_tenth += p < 0.1 ? 1 : 0;
    below_hundredth += p < 0.01 ? 1 : 0;
  }
  // Four standard deviations of the counts.
  EXPECT_NEAR(below_tenth, 0.1 * kDraws, 4.0 * std::sqrt(0.09 * kDraws));
  EXPECT_NEAR(below_hundredth, 0.01 * kDraws, 4.0 * std::sqrt(0.0099 * kDraws));
}

TEST(ChanceOfGap, IsNotTooSmallForTailsThatFallFaster) {
  Random random(12);
  constexpr int kDraws = 20000;
  int below_hundredth = 0;
  for (int i = 0; i < kDraws; ++i)
    below_hundredth += stated(25, random, [](Random& r) { return r.normal(); }) < 0.01 ? 1 : 0;
  // The top of 25 normal values spreads a little more than the spacings below it.
  EXPECT_LT(below_hundredth, 0.015 * kDraws);
}

TEST(ChanceOfGap, NeedsOthersToCompareWith) {
  EXPECT_TRUE(std::isnan(chance_of_gap(3.0, {1.0, 2.0, 0.0, -1.0})));
  EXPECT_TRUE(std::isnan(chance_of_gap(3.0, {1.0, 1.0, 1.0, 1.0, 1.0})));
  EXPECT_EQ(chance_of_gap(1.0, {1.0, 2.0, 0.0, -1.0, -2.0}), 1.0);
  // Spacings of 1 to 4 others: the sum is 4 + 4 + 3 + 2 + 1.
  EXPECT_DOUBLE_EQ(chance_of_gap(34.0, {4.0, 3.0, 2.0, 1.0, 0.0}), std::pow(1.0 + 30.0 / 14.0, -4.0));
}

}  // namespace
}  // namespace asperity
