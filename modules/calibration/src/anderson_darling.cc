#include "anderson_darling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace asperity {

namespace {

// ln Φ(z), also far out, where Φ itself is no number of a double any more.
double log_normal_cdf(double z) {
  if (z > -30.0) return std::log(0.5 * std::erfc(-z / std::numbers::sqrt2));
  return -0.5 * z * z - std::log(-z * std::sqrt(2.0 * std::numbers::pi));
}

double probability_of(double a) {
  if (a >= 0.6) return std::exp(std::max(-700.0, 1.2937 - 5.709 * a + 0.0186 * a * a));
  if (a >= 0.34) return std::exp(0.9177 - 4.279 * a - 1.38 * a * a);
  if (a >= 0.2) return 1.0 - std::exp(-8.318 + 42.796 * a - 59.938 * a * a);
  return 1.0 - std::exp(-13.436 + 101.14 * a - 223.73 * a * a);
}

}  // namespace

GaussianTest test_gaussian(std::vector<double> x) {
  GaussianTest out;
  const auto n = static_cast<double>(x.size());
  double mean = 0.0, m2 = 0.0, m3 = 0.0, m4 = 0.0;
  for (const double value : x) mean += value / n;
  for (const double value : x) {
    const double d = value - mean;
    m2 += d * d / n;
    m3 += d * d * d / n;
    m4 += d * d * d * d / n;
  }
  if (!(m2 > 0.0)) return out;
  out.skewness = m3 / std::pow(m2, 1.5);
  out.excess_kurtosis = m4 / (m2 * m2) - 3.0;
  const double deviation = std::sqrt(m2 * n / (n - 1.0));
  std::sort(x.begin(), x.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double low = (x[i] - mean) / deviation, high = (x[x.size() - 1 - i] - mean) / deviation;
    sum += (2.0 * static_cast<double>(i) + 1.0) * (log_normal_cdf(low) + log_normal_cdf(-high));
  }
  out.anderson_darling = (-n - sum / n) * (1.0 + 0.75 / n + 2.25 / (n * n));
  // The formula turns round beyond 13, where the probability is below 1e-30.
  out.probability = probability_of(std::min(out.anderson_darling, 13.0));
  return out;
}

}  // namespace asperity
