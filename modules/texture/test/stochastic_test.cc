#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/texture/evaluate_stochastic.h"
#include "asperity/texture/fit_stochastic.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

struct Moments {
  double mean = 0.0, sigma = 0.0, kurtosis = 0.0, lag_one = 0.0;
};

Moments moments(const std::vector<double>& x) {
  Moments m;
  const double n = static_cast<double>(x.size());
  for (const double v : x) m.mean += v / n;
  double m2 = 0.0, m4 = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double d = x[i] - m.mean;
    m2 += d * d / n;
    m4 += d * d * d * d / n;
    if (i > 0) m.lag_one += d * (x[i - 1] - m.mean) / n;
  }
  m.sigma = std::sqrt(m2);
  m.kurtosis = m4 / (m2 * m2);
  m.lag_one /= m2;
  return m;
}

std::vector<double> heights(const StochasticTexture& t, double speed_mps, double force_N, int count) {
  SeriesState state = start_series(3);
  std::vector<double> x(static_cast<std::size_t>(count));
  for (double& v : x) v = next_height_m(t, state, speed_mps, force_N, 1e-3);
  return x;
}

constexpr int kCount = 200000;

TEST(Stochastic, IsWhiteAndGaussian) {
  const auto m = moments(heights({.sigma_m = 2e-6, .offset_sigmas = 0.0}, 0.05, 1.0, kCount));
  // Five standard errors of each for independent samples.
  const double se = 1.0 / std::sqrt(double(kCount));
  EXPECT_NEAR(m.mean, 0.0, 5.0 * se * 2e-6);
  EXPECT_NEAR(m.sigma, 2e-6, 5.0 * se * 2e-6 / std::numbers::sqrt2);
  EXPECT_NEAR(m.kurtosis, 3.0, 5.0 * se * std::sqrt(24.0));
  EXPECT_NEAR(m.lag_one, 0.0, 5.0 * se);
}

TEST(Stochastic, ImpulsesFollowTheDistance) {
  // 50 µm a step with impulses every 200 µm: neighbours are alike, and the variance is the same between them.
  const StochasticTexture t{.sigma_m = 2e-6, .correlation_length_m = 2e-4, .offset_sigmas = 0.0};
  const auto slow = moments(heights(t, 0.05, 1.0, kCount));
  EXPECT_NEAR(slow.sigma, 2e-6, 0.03 * 2e-6);
  EXPECT_GT(slow.lag_one, 0.8);
  // 1 mm a step: every step at another impulse.
  const auto fast = moments(heights(t, 1.0, 1.0, kCount));
  EXPECT_NEAR(fast.sigma, 2e-6, 0.03 * 2e-6);
  EXPECT_NEAR(fast.lag_one, 0.0, 0.02);
}

TEST(Stochastic, IsOffsetAndClamped) {
  const StochasticTexture t{.sigma_m = 2e-6, .tangential_ratio = 0.4, .stiffness_N_per_m = 1000.0};
  SeriesState state = start_series(3);
  bool low = false, high = false;
  for (int i = 0; i < kCount; ++i) {
    const auto f = next_force(t, state, 0.05, 1.0, 1e-3);
    ASSERT_GE(f.normal_N, 0.0);
    ASSERT_LE(f.normal_N, 0.012 * (1.0 + 1e-12));
    ASSERT_NEAR(f.tangential_N, 0.4 * (f.normal_N - 0.006), 1e-15);
    low = low || f.normal_N < 0.0005;
    high = high || f.normal_N > 0.0115;
  }
  EXPECT_TRUE(low && high);
}

TEST(Stochastic, ScalesWithSpeedAndForceAndFades) {
  const StochasticTexture t{.sigma_m = 2e-6, .offset_sigmas = 0.0, .speed_exponent = 1.0, .force_exponent = 0.5};
  EXPECT_NEAR(moments(heights(t, 0.1, 4.0, kCount)).sigma, 2.0 * 2.0 * 2e-6, 0.05e-6);
  EXPECT_EQ(moments(heights(t, 0.0, 1.0, 100)).sigma, 0.0);
  const StochasticTexture inverse{.sigma_m = 2e-6, .speed_exponent = -3.0};
  for (const double speed : {0.0, 1e-30, std::nan(""), double(INFINITY), -1.0})
    for (const double h : heights(inverse, speed, 1.0, 100)) ASSERT_TRUE(std::isfinite(h) && h <= 6.0 * 10.0 * 2e-6);
}

TEST(FitStochastic, RecognisesItsOwn) {
  Random random(2);
  std::vector<double> z(20000);
  for (double& v : z) v = 1e-4 + 3e-6 * random.normal();
  z[7] = std::nan("");
  const auto fit = fit_stochastic(z, 2.5e-5);
  EXPECT_NEAR(fit.texture.sigma_m, 3e-6, 0.03 * 3e-6);
  EXPECT_EQ(fit.samples, 19999u);
  EXPECT_LT(fit.kolmogorov_distance, 1.63 / std::sqrt(20000.0));  // Kolmogorov's 1 % quantile
  EXPECT_NEAR(fit.excess_kurtosis, 0.0, 5.0 * std::sqrt(24.0 / 20000.0));
  // Welch's estimate of some 15 segments scatters by 20 %: half the mean deviation.
  EXPECT_LT(fit.not_white, 0.15);
  EXPECT_THAT(fit.problems, IsEmpty());
}

TEST(FitStochastic, SaysThatAPatternIsNoNoise) {
  std::vector<double> z(4000);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = 5e-4 * std::sin(2.0 * std::numbers::pi * static_cast<double>(i) / 100.0);
  const auto fit = fit_stochastic(z, 2.5e-5);
  EXPECT_NEAR(fit.texture.sigma_m, 5e-4 / std::numbers::sqrt2, 1e-8);
  EXPECT_NEAR(fit.excess_kurtosis, -1.5, 1e-3);  // of a sine
  // The arcsine distribution is 0.106 from the normal one of the same variance (by table of both).
  EXPECT_NEAR(fit.kolmogorov_distance, 0.106, 0.01);
  EXPECT_GT(fit.not_white, 0.9);
  EXPECT_GT(fit.misplaced_power, 0.5);
  ASSERT_EQ(fit.problems.size(), 1u);
  EXPECT_EQ(fit.problems[0].kind, "not_stochastic");
}

TEST(FitStochastic, GrainLowersTheMisplacedPower) {
  Random random(2);
  std::vector<double> z(40000);
  double x = 0.0;
  for (double& v : z) v = x = 0.9 * x + 1e-6 * random.normal();
  const auto fit = fit_stochastic(z, 2.5e-5);
  // r = 0.9^(s/25 µm) falls below 1/e at 9.49 samples.
  EXPECT_NEAR(fit.correlation_length_m, 9.49 * 2.5e-5, 0.1 * 9.49 * 2.5e-5);
  EXPECT_GT(fit.not_white, 0.5);
  EXPECT_LT(fit.misplaced_power, 0.5 * fit.not_white);
}

TEST(FitStochastic, RefusesWhatIsNoProfile) {
  EXPECT_THAT([] { fit_stochastic(std::vector<double>(63, 1.0), 1e-5); },
              ThrowsMessage<Error>(HasSubstr("63 heights")));
  EXPECT_THAT([] { fit_stochastic(std::vector<double>(100, 1.0), 1e-5); }, ThrowsMessage<Error>(HasSubstr("equal")));
  EXPECT_THAT([] { fit_stochastic(std::vector<double>(100, 1.0), 0.0); }, ThrowsMessage<Error>(HasSubstr("spacing 0")));
  std::vector<double> z(100, 1.0);
  z[3] = INFINITY;
  EXPECT_THAT([&] { fit_stochastic(z, 1e-5); }, ThrowsMessage<Error>(HasSubstr("height 4")));
}

}  // namespace
}  // namespace asperity
