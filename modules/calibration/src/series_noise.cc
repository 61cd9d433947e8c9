#include "asperity/calibration/series_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "anderson_darling.h"
#include "asperity/base/error.h"
#include "nelder_mead.h"

namespace asperity {

namespace {

// Times and values in units of the typical step and of the scatter.
struct Series {
  std::span<const double> t, x;
  double step_s = 0.0;
  double span_s = 0.0;
};

struct Likelihood {
  double log_determinant = 0.0;  // of the covariance and of the mean's information
  double square = 0.0;           // the generalised sum of squares about the estimated mean
  double mean = 0.0;

  // Minus twice the restricted log-likelihood, up to a constant.
  double value(double scale, double n) const { return log_determinant + (n - 1.0) * std::log(scale) + square / scale; }
};

// White variance `white`, slow variance `slow`. Calls `innovation(i, of x, of a constant, variance)`.
template <class Innovation>
Likelihood run_filter(const Series& series, double white, double slow, double time_s, Innovation innovation) {
  Likelihood out;
  double state_x = 0.0, state_one = 0.0, variance = slow;
  double xx = 0.0, xo = 0.0, oo = 0.0;
  double last_step = -1.0, decay = 0.0;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (i > 0) {
      const double step = series.t[i] - series.t[i - 1];
      if (step != last_step) {
        decay = std::exp(-step / time_s);
        last_step = step;
      }
      state_x *= decay;
      state_one *= decay;
      variance = slow + decay * decay * (variance - slow);
    }
    const double s = variance + white;
    const double ex = series.x[i] - state_x, eo = 1.0 - state_one;
    innovation(i, ex, eo, s);
    out.log_determinant += std::log(s);
    xx += ex * ex / s;
    xo += ex * eo / s;
    oo += eo * eo / s;
    const double gain = variance / s;
    state_x += gain * ex;
    state_one += gain * eo;
    variance -= gain * variance;
  }
  if (!(oo > 0.0)) return out;  // an empty series says nothing
  out.mean = xo / oo;
  out.square = xx - xo * xo / oo;
  out.log_determinant += std::log(oo);
  return out;
}

Likelihood run_filter(const Series& series, double white, double slow, double time_s) {
  return run_filter(series, white, slow, time_s, [](std::size_t, double, double, double) {});
}

// (ln slow²/white², ln time).
using Ratio = Eigen::Vector2d;
// (ln white, ln slow, ln time).
using Logs = Eigen::Vector3d;

double profiled(const Series& series, const Ratio& at) {
  const auto n = static_cast<double>(series.x.size());
  // Between a step and three times the whole span: outside, the slow part is white or a part of the mean.
  if (at[1] < std::log(series.step_s) || at[1] > std::log(3.0 * series.span_s) || std::abs(at[0]) > 20.0) {
    return std::numeric_limits<double>::infinity();
  }
  const Likelihood likelihood = run_filter(series, 1.0, std::exp(at[0]), std::exp(at[1]));
  return likelihood.value(likelihood.square / (n - 1.0), n);
}

double exact(const Series& series, const Logs& at) {
  const Likelihood likelihood = run_filter(series, std::exp(2.0 * at[0]), std::exp(2.0 * at[1]), std::exp(at[2]));
  return likelihood.value(1.0, static_cast<double>(series.x.size()));
}

// The inverse of half the curvature of minus twice the log-likelihood; infinite if it is not a minimum.
Eigen::Matrix3d covariance_of(const Series& series, const Logs& at) {
  constexpr double kStep = 0.03;  // of a logarithm: 3 %
  Eigen::Matrix3d curvature;
  const double centre = exact(series, at);
  for (int i = 0; i < 3; ++i) {
    const Logs di = kStep * Logs::Unit(i);
    curvature(i, i) = (exact(series, at + di) - 2.0 * centre + exact(series, at - di)) / (kStep * kStep);
    for (int j = 0; j < i; ++j) {
      const Logs dj = kStep * Logs::Unit(j);
      curvature(i, j) = curvature(j, i) = (exact(series, at + di + dj) - exact(series, at + di - dj) -
                                           exact(series, at - di + dj) + exact(series, at - di - dj)) /
                                          (4.0 * kStep * kStep);
    }
  }
  const Eigen::LLT<Eigen::Matrix3d> root(0.5 * curvature);
  if (root.info() != Eigen::Success) return Eigen::Matrix3d::Constant(std::numeric_limits<double>::infinity());
  return root.solve(Eigen::Matrix3d::Identity());
}

void test_shape(const Series& series, double white, double slow, double time_s, SeriesNoise& out) {
  std::vector<double> z(series.x.size());
  const double mean = run_filter(series, white, slow, time_s).mean;
  run_filter(series, white, slow, time_s,
             [&](std::size_t i, double ex, double eo, double s) { z[i] = (ex - mean * eo) / std::sqrt(s); });
  const GaussianTest test = test_gaussian(std::move(z));
  out.skewness = test.skewness;
  out.excess_kurtosis = test.excess_kurtosis;
  out.anderson_darling = test.anderson_darling;
  out.gaussian_probability = test.probability;
}

double sample_deviation(std::span<const double> x) {
  const auto n = static_cast<double>(x.size());
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
  double square = 0.0;
  for (const double value : x) square += (value - mean) * (value - mean);
  return std::sqrt(square / (n - 1.0));
}

void check_series(std::span<const double> t_s, std::span<const double> x) {
  constexpr std::size_t kFewest = 8;
  if (t_s.size() != x.size() || x.size() < kFewest) {
    throw Error(fmt::format("series noise: {} times for {} values, must be as many and at least {}", t_s.size(),
                            x.size(), kFewest));
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(t_s[i]))
      throw Error(fmt::format("series noise: value {} is not finite", i));
    if (i > 0 && !(t_s[i] > t_s[i - 1])) throw Error(fmt::format("series noise: time {} does not rise", i));
  }
}

}  // namespace

SeriesNoise fit_series_noise(std::span<const double> t_s, std::span<const double> x) {
  check_series(t_s, x);
  SeriesNoise out;
  out.samples = x.size();
  const auto n = static_cast<double>(x.size());
  const double scatter = sample_deviation(x);
  if (!(scatter > 0.0)) return out;
  // The filter sees values of the order of one, about zero.
  std::vector<double> scaled(x.begin(), x.end());
  for (double& value : scaled) value = (value - x[0]) / scatter;
  Series series{t_s, scaled, 0.0, t_s.back() - t_s.front()};
  series.step_s = series.span_s / (n - 1.0);

  const double white_only = profiled(series, {-20.0, std::log(series.step_s) + 1.0});
  Ratio best(-20.0, 0.0);
  double least = white_only;
  for (const double share : {0.02, 0.2}) {
    const double time_s = std::max(3.0 * series.step_s, share * series.span_s);
    const Ratio at = nelder_mead<2>([&](const Ratio& r) { return profiled(series, r); },
                                    {std::log(0.3), std::log(time_s)}, 0.8, 1e-4);
    const double value = profiled(series, at);
    if (value < least) {
      least = value;
      best = at;
    }
  }
  constexpr double kVisible = 9.0;
  out.has_slow = white_only - least > kVisible;
  if (!out.has_slow) {
    out.white = out.total = scatter;
    out.white_error = out.total_error = scatter / std::sqrt(2.0 * (n - 1.0));
    out.effective_samples = n;
    test_shape(series, 1.0, 0.0, series.step_s, out);
    return out;
  }
  const double ratio = std::exp(best[0]), time_s = std::exp(best[1]);
  const double white2 = run_filter(series, 1.0, ratio, time_s).square / (n - 1.0);
  const Logs logs(0.5 * std::log(white2), 0.5 * std::log(white2 * ratio), best[1]);
  const Eigen::Matrix3d covariance = covariance_of(series, logs);
  const double white = std::sqrt(white2), slow = std::sqrt(white2 * ratio);
  out.white = scatter * white;
  out.white_error = out.white * std::sqrt(covariance(0, 0));
  out.slow = scatter * slow;
  out.slow_error = out.slow * std::sqrt(covariance(1, 1));
  out.slow_time_s = time_s;
  out.slow_time_error_s = time_s * std::sqrt(covariance(2, 2));
  const double total2 = white2 * (1.0 + ratio);
  out.total = scatter * std::sqrt(total2);
  const Eigen::Vector2d by_logs = Eigen::Vector2d(white2, white2 * ratio) / total2;  // of ln total
  out.total_error = out.total * std::sqrt(by_logs.dot(covariance.topLeftCorner<2, 2>() * by_logs));
  // Σ of the squared autocovariances over all lags (Bartlett, 1946).
  const double decay = std::exp(-2.0 * series.step_s / time_s);
  const double sum = total2 * total2 + 2.0 * white2 * ratio * white2 * ratio * decay / (1.0 - decay);
  out.effective_samples = n * total2 * total2 / sum;
  test_shape(series, white2, white2 * ratio, time_s, out);
  return out;
}

}  // namespace asperity
