#include <array>
#include <cmath>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/study/bradley_terry.h"
#include "asperity/study/interval.h"

namespace asperity {
namespace {

// Two things: ln(wins / losses) between them, its variance 1/wins + 1/losses.
TEST(BradleyTerry, OfTwoIsTheLogarithmOfTheOdds) {
  Eigen::MatrixXd wins(2, 2);
  wins << 0, 30, 10, 0;
  const BradleyTerry fit = fit_bradley_terry(wins);
  ASSERT_TRUE(fit.exists && fit.converged);
  EXPECT_NEAR(fit.worth_ln(0) - fit.worth_ln(1), std::log(3.0), 1e-9);
  EXPECT_NEAR(fit.worth_ln.sum(), 0.0, 1e-12);
  const double variance = fit.covariance(0, 0) + fit.covariance(1, 1) - 2.0 * fit.covariance(0, 1);
  EXPECT_NEAR(variance, 1.0 / 30.0 + 1.0 / 10.0, 1e-9);
}

// Baseball, American League 1987 (Agresti 1990, table 10.10), and the estimates relative to Baltimore with their
// standard errors that the R package BradleyTerry2 prints (Turner and Firth 2012, four decimals).
TEST(BradleyTerry, AgreesWithPublishedWorths) {
  Eigen::MatrixXd wins(7, 7);    // Milwaukee, Detroit, Toronto, New York, Boston, Cleveland, Baltimore
  wins << 0, 7, 9, 7, 7, 9, 11,  //
      6, 0, 7, 5, 11, 9, 9,      //
      4, 6, 0, 7, 7, 8, 12,      //
      6, 8, 6, 0, 6, 7, 10,      //
      6, 2, 6, 7, 0, 7, 12,      //
      4, 4, 5, 6, 6, 0, 6,       //
      2, 4, 1, 3, 1, 7, 0;
  const std::array<double, 6> worth{1.5814, 1.4364, 1.2945, 1.2476, 1.1077, 0.6839};
  const std::array<double, 6> error{0.3433, 0.3396, 0.3367, 0.3359, 0.3339, 0.3319};
  const BradleyTerry fit = fit_bradley_terry(wins);
  ASSERT_TRUE(fit.exists && fit.converged);
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_NEAR(fit.worth_ln(i) - fit.worth_ln(6), worth.at(static_cast<std::size_t>(i)), 1e-4) << i;
    const double variance = fit.covariance(i, i) + fit.covariance(6, 6) - 2.0 * fit.covariance(i, 6);
    EXPECT_NEAR(std::sqrt(variance), error.at(static_cast<std::size_t>(i)), 1e-4) << i;
  }
}

// Observers who choose with known probabilities: the errors are as large as they are said to be.
TEST(BradleyTerry, RecoversWorthsWithinItsErrors) {
  const Eigen::Vector4d truth(0.9, 0.2, -0.3, -0.8);
  Random random(7);
  constexpr int kRuns = 400, kTrials = 40;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero(), squares = Eigen::Vector4d::Zero();
  for (int run = 0; run < kRuns; ++run) {
    Eigen::MatrixXd wins = Eigen::MatrixXd::Zero(4, 4);
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        for (int trial = 0; trial < kTrials; ++trial) {
          const bool first = random.chance(1.0 / (1.0 + std::exp(truth(j) - truth(i))));
          wins(first ? i : j, first ? j : i) += 1.0;
        }
      }
    }
    const BradleyTerry fit = fit_bradley_terry(wins);
    ASSERT_TRUE(fit.exists && fit.converged);
    sum += fit.worth_ln - truth;
    squares += (fit.worth_ln - truth).cwiseAbs2().cwiseQuotient(fit.covariance.diagonal());
  }
  // Maximum likelihood is biased outwards by the order of 1/N: some 2 % of the largest worth.
  EXPECT_LT((sum / kRuns).cwiseAbs().maxCoeff(), 0.05);
  // A mean of 400 squares of unit normals has a standard deviation of 0.07.
  EXPECT_LT((squares / kRuns - Eigen::Vector4d::Ones()).cwiseAbs().maxCoeff(), 0.25);
}

TEST(BradleyTerry, SaysWhenThereIsNoSuchThing) {
  Eigen::MatrixXd always(3, 3);  // the first won always
  always << 0, 5, 5, 0, 0, 3, 0, 2, 0;
  EXPECT_FALSE(fit_bradley_terry(always).exists);
  Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(4, 4);  // 0 and 1, 2 and 3 were never compared
  apart(0, 1) = apart(1, 0) = apart(2, 3) = apart(3, 2) = 4;
  EXPECT_FALSE(fit_bradley_terry(apart).exists);
  EXPECT_FALSE(fit_bradley_terry(Eigen::MatrixXd::Zero(1, 1)).exists);
  EXPECT_THROW(fit_bradley_terry(Eigen::MatrixXd::Zero(2, 3)), Error);
  always(0, 1) = -1;
  EXPECT_THROW(fit_bradley_terry(always), Error);
}

// Newcombe 1998, table I, method 3, four decimals.
TEST(WilsonInterval, AgreesWithPublishedOnes) {
  struct Case {
    double successes, trials, low, high;
  };
  for (const Case& one : {Case{81, 263, 0.2553, 0.3662}, Case{15, 148, 0.0624, 0.1605}, Case{0, 20, 0.0, 0.1611},
                          Case{1, 29, 0.0061, 0.1718}}) {
    const Interval interval = wilson_interval(one.successes, one.trials);
    EXPECT_NEAR(interval.low, one.low, 5.1e-5) << one.successes;
    EXPECT_NEAR(interval.high, one.high, 5.1e-5) << one.successes;
  }
  EXPECT_EQ(wilson_interval(0, 0).low, 0.0);
  EXPECT_EQ(wilson_interval(0, 0).high, 1.0);
}

// t with 4 degrees of freedom at 97.5 % is 2.7764 in every table.
TEST(MeanOfRatings, HasTheIntervalOfStudent) {
  const std::array<int, 5> values{2, 3, 4, 5, 6};
  const MeanOfRatings mean = mean_of_ratings(values, {1, 7});
  EXPECT_DOUBLE_EQ(mean.mean, 4.0);
  EXPECT_NEAR(mean.deviation, std::sqrt(2.5), 1e-12);
  EXPECT_NEAR(mean.interval.high - 4.0, 2.7764 * std::sqrt(2.5 / 5.0), 1e-4);
  EXPECT_NEAR(mean.interval.low, 8.0 - mean.interval.high, 1e-12);
  const std::array<int, 1> one{7};
  EXPECT_EQ(mean_of_ratings(one, {1, 7}).interval.low, 1.0);
  const std::array<int, 2> ends{1, 7};
  EXPECT_EQ(mean_of_ratings(ends, {1, 7}).interval.high, 7.0);
}

}  // namespace
}  // namespace asperity
