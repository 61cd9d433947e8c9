// Against sums over all outcomes in exact fractions of small numbers, and values of the textbook's tables.
#include "asperity/study/plan_power.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "asperity/base/error.h"

namespace asperity {
namespace {

// Counts all 2^n sequences of outcomes: each has a probability of its own, and none is summed by a formula.
double power_by_counting(int n, double share, double alpha) {
  std::vector<double> count(static_cast<std::size_t>(n) + 1, 0.0);
  for (std::uint32_t outcome = 0; outcome < (1U << static_cast<unsigned>(n)); ++outcome) {
    count[static_cast<std::size_t>(__builtin_popcount(outcome))] += 1.0;
  }
  const double all = std::ldexp(1.0, n);
  double power = 0.0;
  for (int k = 0; k <= n; ++k) {
    const int nearer = std::min(k, n - k);
    double tail = 0.0;
    for (int i = 0; i <= nearer; ++i) tail += count[static_cast<std::size_t>(i)] / all;
    if (2.0 * tail > alpha || 2 * nearer == n) continue;
    power += count[static_cast<std::size_t>(k)] * std::pow(share, k) * std::pow(1.0 - share, n - k);
  }
  return power;
}

TEST(PlanPower, IsTheSumOverAllOutcomes) {
  for (const int n : {1, 5, 6, 10, 15, 18}) {
    for (const double share : {0.55, 0.75, 0.9}) {
      // Rounding of some thousand terms.
      EXPECT_NEAR(power_of_trials(n, share, 0.05), power_by_counting(n, share, 0.05), 1e-12) << n << ' ' << share;
    }
  }
}

TEST(PlanPower, TwentyTrialsReject5AndFewerAnd15AndMore) {
  // Of 20 trials a two-sided test at 5 % rejects k <= 5 and k >= 15 (P = 2 * 0.02069): a table of the sign test.
  EXPECT_NEAR(power_of_trials(20, 0.5 + 1e-12, 0.05), 2.0 * 0.020695, 1e-5);
}

TEST(PlanPower, FromTheAnswerOnThePowerIsThere) {
  for (const double share : {0.6, 0.75, 0.9}) {
    const PowerConfig config{share, 0.05, 0.8};
    const int n = trials_for_power(config);
    EXPECT_LT(power_of_trials(n - 1, share, 0.05), 0.8);
    for (int k = n; k < n + 60; ++k) EXPECT_GE(power_of_trials(k, share, 0.05), 0.8) << k;
    // The share of the other texture asks for the same.
    EXPECT_EQ(trials_for_power({1.0 - share, 0.05, 0.8}), n);
  }
}

TEST(PlanPower, RefusesWhatIsNoTest) {
  EXPECT_THROW(trials_for_power({0.5, 0.05, 0.8}), Error);
  EXPECT_THROW(trials_for_power({0.5001, 0.05, 0.8}), Error);
  EXPECT_THROW(trials_for_power({0.75, 0.0, 0.8}), Error);
  EXPECT_THROW(trials_for_power({0.75, 0.05, 1.0}), Error);
  EXPECT_THROW(power_of_trials(0, 0.75, 0.05), Error);
}

}  // namespace
}  // namespace asperity
