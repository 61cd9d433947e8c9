#include "asperity/profile/likely_compliance.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(LikelyCompliance, OfAPreciseMeasurementIsThatMeasurement) {
  EXPECT_NEAR(likely_compliance_mm_per_N(0.5, 0.01), 0.5, 0.002);
  EXPECT_NEAR(likely_compliance_mm_per_N(0.02, 0.0005), 0.02, 0.0001);
}

// ∫ c dc / ∫ dc/c over 0.001 to 1.
TEST(LikelyCompliance, OfNoneIsThatOfThePrior) {
  const double prior = std::sqrt(0.5 * (1.0 - 1e-6) / std::log(1000.0));
  EXPECT_NEAR(likely_compliance_mm_per_N(std::numeric_limits<double>::quiet_NaN(), 0.1), prior, 1e-4);
  EXPECT_NEAR(likely_compliance_mm_per_N(0.1, std::numeric_limits<double>::infinity()), prior, 1e-4);
  EXPECT_NEAR(likely_compliance_mm_per_N(0.1, 1e4), prior, 1e-4);
}

// A measurement of 0 ± σ with σ well inside the limits: ∫ c exp(−c²/2σ²) dc = σ², and the integral of the weights is
// ln(σ/0.001) + (ln 2 − γ)/2, γ Euler's constant.
TEST(LikelyCompliance, OfNoneSeenIsBelowItsStandardError) {
  const double sigma = 0.05, euler = 0.5772156649;
  const double expected = sigma / std::sqrt(std::log(sigma / 1e-3) + 0.5 * (std::log(2.0) - euler));
  EXPECT_NEAR(likely_compliance_mm_per_N(0.0, sigma), expected, 0.005 * expected);
}

TEST(LikelyCompliance, BeyondTheLimitsIsAtTheLimit) {
  EXPECT_NEAR(likely_compliance_mm_per_N(-3.0, 0.01), 1e-3, 1e-3);
  EXPECT_NEAR(likely_compliance_mm_per_N(50.0, 0.1), 1.0, 0.01);
}

}  // namespace
}  // namespace asperity
