#include "asperity/signal/statistics.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/signal/moving_average.h"

namespace asperity {
namespace {

TEST(Statistics, SmallCasesByHand) {
  const std::vector<double> x{2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
  EXPECT_DOUBLE_EQ(mean(x), 5.0);
  EXPECT_DOUBLE_EQ(variance(x), 32.0 / 7.0);
  EXPECT_DOUBLE_EQ(rms(x), std::sqrt(29.0));
  EXPECT_DOUBLE_EQ(median(x), 4.5);
  EXPECT_DOUBLE_EQ(median_absolute_deviation(x), 0.5);
  EXPECT_DOUBLE_EQ(percentile(x, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(percentile(x, 100.0), 9.0);
  EXPECT_DOUBLE_EQ(percentile(x, 90.0), 7.6);  // place 6.3: 7 + 0.3·2
  EXPECT_DOUBLE_EQ(median(std::vector<double>{3.0}), 3.0);
  EXPECT_THROW(mean({}), Error);
  EXPECT_THROW(variance(std::vector<double>{1.0}), Error);
  EXPECT_THROW(percentile(x, 101.0), Error);
}

TEST(Statistics, MadOfNormalSamplesIsTheirSigma) {
  Random random(2);
  std::vector<double> x(100000);
  for (double& v : x) v = 3.0 * random.normal();
  EXPECT_NEAR(kSigmaPerMad * median_absolute_deviation(x), 3.0, 0.05);  // standard error 0.011
}

TEST(Statistics, CorrelationOfLinesAndConstants) {
  const std::vector<double> x{1.0, 2.0, 4.0};
  EXPECT_DOUBLE_EQ(correlation(x, std::vector<double>{3.0, 5.0, 9.0}), 1.0);
  EXPECT_DOUBLE_EQ(correlation(x, std::vector<double>{-3.0, -5.0, -9.0}), -1.0);
  EXPECT_DOUBLE_EQ(correlation(x, std::vector<double>{1.0, 1.0, 1.0}), 0.0);
  EXPECT_THROW(correlation(x, std::vector<double>{1.0}), Error);
}

// Seed Fig. 11: ten points of the force sensor's calibration.
TEST(Statistics, RegressionOfTheSeedsForceCalibration) {
  const std::vector<double> counts{48, 95, 100, 105, 115, 128, 155, 161, 185, 195};
  const std::vector<double> force_N{0.00, 1.14, 1.24, 1.34, 1.54, 1.79, 2.29, 2.44, 3.54, 3.84};
  const LinearFit fit = linear_regression(counts, force_N);
  EXPECT_NEAR(fit.slope, 0.025095, 5e-7);
  EXPECT_NEAR(fit.intercept, -1.313768, 1e-6);  // it is -1.3137675: the last printed digit is rounded up
  EXPECT_NEAR(fit.residual, 0.196, 5e-4);
}

// Standard errors against the scatter of many seeded repetitions.
TEST(Statistics, RegressionErrorsAreTheScatterOfRepetitions) {
  Random random(3);
  std::vector<double> x, slopes, intercepts;
  for (int i = 0; i < 20; ++i) x.push_back(5.0 + 0.5 * i);
  double slope_error = 0.0, intercept_error = 0.0;
  constexpr int kRepetitions = 4000;
  for (int k = 0; k < kRepetitions; ++k) {
    std::vector<double> y;
    for (const double v : x) y.push_back(2.0 * v - 1.0 + 0.3 * random.normal());
    const LinearFit fit = linear_regression(x, y);
    slopes.push_back(fit.slope);
    intercepts.push_back(fit.intercept);
    slope_error += fit.slope_error / kRepetitions;
    intercept_error += fit.intercept_error / kRepetitions;
  }
  EXPECT_NEAR(standard_deviation(slopes) / slope_error, 1.0, 0.05);
  EXPECT_NEAR(standard_deviation(intercepts) / intercept_error, 1.0, 0.05);
  EXPECT_NEAR(mean(slopes), 2.0, 0.01);
  EXPECT_THROW(linear_regression(std::vector<double>{1.0, 1.0}, std::vector<double>{1.0, 2.0}), Error);
}

TEST(MovingAverage, IsTheMeanOfTheWindow) {
  Random random(4);
  std::vector<double> x(1000);
  for (double& v : x) v = 1e6 + random.normal();
  for (const std::size_t half : {0u, 1u, 7u, 400u, 5000u}) {
    const auto y = moving_average(x, half);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t first = i > half ? i - half : 0;
      const std::size_t last = std::min(i + half, x.size() - 1);
      const double expected = mean(std::span(x).subspan(first, last - first + 1));
      EXPECT_NEAR(y[i], expected, 1e-6);  // 1e-12 of the level
    }
  }
  EXPECT_TRUE(moving_average({}, 3).empty());
}

}  // namespace
}  // namespace asperity
