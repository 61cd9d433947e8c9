#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/signal/chi_square.h"

namespace asperity {
namespace {

// −2 ln(1 − p) for two degrees of freedom; the others are of published tables.
TEST(ChiSquare, HasTheQuantilesOfTables) {
  EXPECT_NEAR(chi_square_quantile(0.95, 1.0), 3.841458820694124, 1e-9);
  EXPECT_NEAR(chi_square_quantile(0.025, 2.0), 0.05063561596857975, 1e-11);
  EXPECT_NEAR(chi_square_quantile(0.975, 10.0), 20.48317735, 1e-7);
  EXPECT_NEAR(chi_square_quantile(0.025, 30.0), 16.79077, 1e-4);
  EXPECT_NEAR(chi_square_quantile(0.05, 100.0), 77.92947, 1e-4);
}

TEST(ChiSquare, RefusesWhatIsNoProbability) {
  EXPECT_THROW(chi_square_quantile(1.0, 2.0), Error);
  EXPECT_THROW(chi_square_quantile(0.5, 0.0), Error);
}

}  // namespace
}  // namespace asperity
