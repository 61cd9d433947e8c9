#include "root_of_power.h"

#include <cmath>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(RootOfPower, IsTheRootWhereTheSquareIsKnownWell) {
  const Root root = root_of_power(16.0, 0.08);
  EXPECT_NEAR(root.value, 4.0, 1e-4);
  EXPECT_NEAR(root.standard_error, 0.01, 1e-5);
}

// ∫ xⁿ exp(−x⁴/2) dx = 2^((n + 1)/4) Γ((n + 1)/4)/4.
TEST(RootOfPower, OfNothingHasAClosedForm) {
  const auto moment = [](int n) { return std::pow(2.0, 0.25 * (n + 1)) * std::tgamma(0.25 * (n + 1)) / 4.0; };
  const double mean = moment(1) / moment(0);
  const Root root = root_of_power(0.0, 1.0);
  EXPECT_NEAR(root.value, mean, 1e-4);
  EXPECT_NEAR(root.standard_error, std::sqrt(moment(2) / moment(0) - mean * mean), 1e-4);
}

TEST(RootOfPower, OfANegativeSquareIsSmall) {
  const Root root = root_of_power(-50.0, 1.0);  // half a normal distribution: exp(−50 x²)
  EXPECT_NEAR(root.value, 0.1 * std::sqrt(2.0 / std::acos(-1.0)), 2e-4);
  EXPECT_TRUE(std::isnan(root_of_power(1.0, 0.0).value));
}

}  // namespace
}  // namespace asperity
