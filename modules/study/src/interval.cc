#include "asperity/study/interval.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace asperity {

namespace {

constexpr double kUpperTail = 0.975;
constexpr double kNormalQuantile = 1.959963984540054;  // of kUpperTail

}  // namespace

Interval wilson_interval(double successes, double trials) {
  if (!(trials > 0.0)) return {0.0, 1.0};
  const double p = successes / trials;
  const double z2 = kNormalQuantile * kNormalQuantile;
  const double middle = (p + 0.5 * z2 / trials) / (1.0 + z2 / trials);
  const double half =
      kNormalQuantile * std::sqrt(p * (1.0 - p) / trials + 0.25 * z2 / (trials * trials)) / (1.0 + z2 / trials);
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

MeanOfRatings mean_of_ratings(std::span<const int> values, Interval scale) {
  MeanOfRatings out;
  const auto count = static_cast<double>(values.size());
  double square = 0.0;
  for (const int value : values) out.mean += value / count;
  for (const int value : values) square += (value - out.mean) * (value - out.mean);
  if (values.size() < 2) {
    out.interval = scale;
    return out;
  }
  out.deviation = std::sqrt(square / (count - 1.0));
  const double half =
      boost::math::quantile(boost::math::students_t(count - 1.0), kUpperTail) * out.deviation / std::sqrt(count);
  out.interval = {std::max(scale.low, out.mean - half), std::min(scale.high, out.mean + half)};
  return out;
}

}  // namespace asperity
