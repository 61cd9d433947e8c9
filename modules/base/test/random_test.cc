#include "asperity/base/random.h"

#include <gtest/gtest.h>
#include <cmath>

namespace asperity {
namespace {

TEST(Random, NormalMoments) {
  Random random(42);
  constexpr int kCount = 200000;
  double mean = 0.0;
  double square = 0.0;
  double fourth = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    mean += x / kCount;
    square += x * x / kCount;
    fourth += x * x * x * x / kCount;
  }
  // Five standard errors of each moment.
  EXPECT_NEAR(mean, 0.0, 5.0 * std::sqrt(1.0 / kCount));
  EXPECT_NEAR(square, 1.0, 5.0 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(fourth, 3.0, 5.0 * std::sqrt(96.0 / kCount));
}

TEST(Random, StreamsDiffer) { EXPECT_NE(Random(1, 0).bits(), Random(1, 1).bits()); }

}  // namespace
}  // namespace asperity
