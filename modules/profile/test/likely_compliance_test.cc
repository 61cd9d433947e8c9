#include "asperity/profile/likely_compliance.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(LikelyCompliance, OfAPreciseMeasurementIsThatMeasurement) {
  const LikelyCompliance soft = likely_compliance(0.5, 0.01), hard = likely_compliance(0.02, 0.0005);
  EXPECT_NEAR(soft.mean_mm_per_N, 0.5, 0.002);
  EXPECT_NEAR(soft.sigma_mm_per_N, 0.01, 0.0002);
  EXPECT_NEAR(hard.mean_mm_per_N, 0.02, 0.0001);
  EXPECT_NEAR(hard.sigma_mm_per_N, 0.0005, 0.00001);
}

// ∫ dc / ∫ dc/c and ∫ c dc / ∫ dc/c over 0.0001 to 1.
TEST(LikelyCompliance, OfNoneIsThatOfThePrior) {
  const double mean = (1.0 - 1e-4) / std::log(1e4), square = 0.5 * (1.0 - 1e-8) / std::log(1e4);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const LikelyCompliance& c :
       {likely_compliance(nan, 0.1), likely_compliance(0.1, infinity), likely_compliance(0.1, 1e4)}) {
    EXPECT_NEAR(c.mean_mm_per_N, mean, 1e-4);
    EXPECT_NEAR(c.sigma_mm_per_N, std::sqrt(square - mean * mean), 1e-4);
  }
}

// A measurement of 0 ± σ with σ well inside the limits: ∫ exp(−c²/2σ²) dc = σ √(π/2) less the 0.0001 below the limit,
// ∫ c exp(−c²/2σ²) dc = σ², and the integral of the weights is ln(σ/0.0001) + (ln 2 − γ)/2, γ Euler's constant.
TEST(LikelyCompliance, OfNoneSeenIsBelowItsStandardError) {
  const double sigma = 0.05, euler = 0.5772156649;
  const double weights = std::log(sigma / 1e-4) + 0.5 * (std::log(2.0) - euler);
  const double mean = (sigma * std::sqrt(0.5 * std::numbers::pi) - 1e-4) / weights, square = sigma * sigma / weights;
  const LikelyCompliance c = likely_compliance(0.0, sigma);
  EXPECT_NEAR(c.mean_mm_per_N, mean, 0.005 * mean);
  EXPECT_NEAR(c.sigma_mm_per_N, std::sqrt(square - mean * mean), 0.005 * sigma);
}

// Values by another integration (SciPy's quad over ln c of stats.t.pdf).
TEST(LikelyCompliance, AnUncertainStandardErrorHasLongTails) {
  const LikelyCompliance seen = likely_compliance(0.3, 0.1, 4.0), unseen = likely_compliance(0.05, 0.08, 6.0);
  EXPECT_NEAR(seen.mean_mm_per_N, 0.192915, 1e-4);
  EXPECT_NEAR(seen.sigma_mm_per_N, 0.148785, 1e-4);
  EXPECT_NEAR(unseen.mean_mm_per_N, 0.023921, 1e-4);
  EXPECT_NEAR(unseen.sigma_mm_per_N, 0.040788, 1e-4);
}

TEST(LikelyCompliance, BeyondTheLimitsIsAtTheLimit) {
  EXPECT_NEAR(likely_compliance(-3.0, 0.01).mean_mm_per_N, 1e-3, 1e-3);
  EXPECT_NEAR(likely_compliance(50.0, 0.1).mean_mm_per_N, 1.0, 0.01);
}

}  // namespace
}  // namespace asperity
