#include "shape_without_noise.h"

#include <algorithm>
#include <cmath>

#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kSurelyThere = 2.0;  // standard errors of the surface's power
constexpr double kNotGaussian = 0.5;  // of the correction

struct Cumulants {
  double second = 0.0, third = 0.0, fourth = 0.0;
};

Cumulants cumulants_of(std::span<const double> x) {
  double sum = 0.0, count = 0.0;
  for (const double v : x) {
    if (!std::isfinite(v)) continue;
    sum += v;
    count += 1.0;
  }
  Cumulants out;
  if (count == 0.0) return out;
  double m4 = 0.0;
  for (const double v : x) {
    if (!std::isfinite(v)) continue;
    const double d = v - sum / count, d2 = d * d;
    out.second += d2 / count;
    out.third += d * d2 / count;
    m4 += d2 * d2 / count;
  }
  out.fourth = m4 - 3.0 * out.second * out.second;
  return out;
}

// Of noise whose size changes along the profile, relative to the square of its mean square.
double excess_of(std::span<const double> sigma) {
  double two = 0.0, four = 0.0, count = 0.0;
  for (const double s : sigma) {
    if (!std::isfinite(s)) continue;
    two += s * s;
    four += s * s * s * s;
    count += 1.0;
  }
  return two > 0.0 ? 3.0 * (four * count / (two * two) - 1.0) : 0.0;
}

}  // namespace

Shape shape_without_noise(std::span<const double> height, double power, double skewness, double kurtosis,
                          const ShapeNoise& noise, std::size_t draws) {
  const double surface = power - noise.power;
  if (!(surface > 0.0)) return {};
  const double share = surface / power;
  const double noise_fourth = excess_of(noise.sigma) * noise.power * noise.power;
  const double skew = skewness / std::pow(share, 1.5);
  const double excess = ((kurtosis - 3.0) * power * power - noise_fourth) / (surface * surface);

  std::vector<double> seconds, skews, excesses, with(height.begin(), height.end());
  for (std::size_t j = 0; j < draws; ++j) {
    const std::vector<double> more = noise.draw();
    for (std::size_t i = 0; i < with.size(); ++i) with[i] = std::sqrt(share) * height[i] + more[i];
    const Cumulants c = cumulants_of(with);
    const double off = (c.second - noise.power) / surface;
    seconds.push_back(off);
    // To first order in the power that came out: the ratio itself has no variance.
    skews.push_back(c.third / std::pow(surface, 1.5) - 1.5 * skew * off);
    excesses.push_back(c.fourth / (surface * surface) - 2.0 * excess * off);
  }
  const double known = noise.power_stderr / surface;
  if (std::hypot(known, standard_deviation(seconds)) * kSurelyThere > 1.0) return {};

  Shape out;
  out.skewness = {skew, std::hypot(standard_deviation(skews), kNotGaussian * (skew - skewness), 1.5 * skew * known)};
  out.kurtosis = {
      std::max(1.0, 3.0 + excess),
      std::hypot(standard_deviation(excesses), kNotGaussian * (3.0 + excess - kurtosis), 2.0 * excess * known)};
  return out;
}

}  // namespace asperity
