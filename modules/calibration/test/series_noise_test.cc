#include "asperity/calibration/series_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "coverage.h"

namespace asperity {
namespace {

struct Series {
  std::vector<double> t_s, x;
};

struct Truth {
  double white = 1.5e-4, slow = 0.0, time_s = 0.5;
  double rate_Hz = 45.0;
  std::size_t samples = 1350;
};

// White noise and an exact Ornstein–Uhlenbeck process at uneven times.
Series simulate(Random& random, const Truth& truth) {
  Series out;
  double t = 12.0, slow = truth.slow * random.normal();
  for (std::size_t i = 0; i < truth.samples; ++i) {
    const double step = random.uniform(0.8, 1.2) / truth.rate_Hz * (random.chance(0.02) ? 3.0 : 1.0);
    t += step;
    const double decay = std::exp(-step / truth.time_s);
    slow = decay * slow + truth.slow * std::sqrt(1.0 - decay * decay) * random.normal();
    out.t_s.push_back(t);
    out.x.push_back(0.3 + slow + truth.white * random.normal());
  }
  return out;
}

constexpr std::size_t kTrials = 200;

TEST(SeriesNoise, StandardErrorsAreTrueForWhiteNoise) {
  test::Coverage coverage;
  std::size_t slow = 0, refused = 0;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(50, trial);
    const Truth truth;
    const Series series = simulate(random, truth);
    const SeriesNoise fit = fit_series_noise(series.t_s, series.x);
    coverage.add("white", fit.white, truth.white, fit.white_error);
    coverage.add("total", fit.total, truth.white, fit.total_error);
    slow += fit.has_slow;
    refused += fit.gaussian_probability < 0.05;
  }
  coverage.expect("tracker noise, white", kTrials);
  std::printf("  a slow part seen in %zu, Gaussian refused at 5 %% in %zu\n", slow, refused);
  EXPECT_LE(slow, 6u);
  // 200 trials at 5 %: 10 ± 3.1.
  EXPECT_LE(refused, 20u);
  EXPECT_GE(refused, 2u);
}

TEST(SeriesNoise, StandardErrorsAreTrueWithASlowPart) {
  test::Coverage coverage;
  std::size_t slow = 0, refused = 0;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(51, trial);
    const Truth truth{.slow = 1.0e-4};
    const Series series = simulate(random, truth);
    const SeriesNoise fit = fit_series_noise(series.t_s, series.x);
    slow += fit.has_slow;
    refused += fit.gaussian_probability < 0.05;
    coverage.add("white", fit.white, truth.white, fit.white_error);
    coverage.add("slow (log)", std::log(fit.slow), std::log(truth.slow), fit.slow_error / fit.slow);
    coverage.add("time (log)", std::log(fit.slow_time_s), std::log(truth.time_s),
                 fit.slow_time_error_s / fit.slow_time_s);
    coverage.add("total", fit.total, std::hypot(truth.white, truth.slow), fit.total_error);
  }
  coverage.expect("tracker noise, white and slow", kTrials);
  EXPECT_EQ(slow, kTrials);
  EXPECT_LE(refused, 20u);
}

TEST(SeriesNoise, TellsOtherShapesFromTheGaussian) {
  Random random(52);
  Series uniform, heavy;
  for (int i = 0; i < 1000; ++i) {
    uniform.t_s.push_back(i / 45.0);
    uniform.x.push_back(random.uniform());
    heavy.x.push_back(random.normal() * (random.chance(0.05) ? 5.0 : 1.0));
  }
  const SeriesNoise flat = fit_series_noise(uniform.t_s, uniform.x), tails = fit_series_noise(uniform.t_s, heavy.x);
  EXPECT_LT(flat.gaussian_probability, 1e-6);
  EXPECT_NEAR(flat.excess_kurtosis, -1.2, 0.15);
  EXPECT_LT(tails.gaussian_probability, 1e-6);
  EXPECT_GT(tails.excess_kurtosis, 3.0);
}

// A change of units by a power of two changes nothing but the units.
TEST(SeriesNoise, IsFreeOfScale) {
  Random random(53);
  Series series = simulate(random, {.slow = 1e-4});
  const SeriesNoise fit = fit_series_noise(series.t_s, series.x);
  for (double& x : series.x) x *= 1048576.0;
  const SeriesNoise scaled = fit_series_noise(series.t_s, series.x);
  EXPECT_DOUBLE_EQ(scaled.white, 1048576.0 * fit.white);
  EXPECT_DOUBLE_EQ(scaled.slow_error, 1048576.0 * fit.slow_error);
}

TEST(SeriesNoise, RefusesWhatIsNoSeries) {
  const std::vector<double> t{0, 1, 2, 3, 4, 5, 6, 7, 8}, x{0, 1, 0, 1, 0, 1, 0, 1, std::nan("")};
  EXPECT_THROW(fit_series_noise(t, x), Error);
  EXPECT_THROW(fit_series_noise(std::span(t).first(4), std::span(x).first(4)), Error);
  EXPECT_THROW(fit_series_noise(std::vector<double>(9, 1.0), t), Error);
  EXPECT_EQ(fit_series_noise(t, std::vector<double>(9, 1.0)).total, 0.0);
}

}  // namespace
}  // namespace asperity
