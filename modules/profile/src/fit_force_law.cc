#include "fit_force_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace asperity {
namespace {

constexpr double kLowest = -2.0, kHighest = 4.0;  // g: beyond, nothing is left of an amplitude within the range
constexpr double kCoarse = 0.05;
constexpr int kScaleSteps = 20;
constexpr int kGoldenSteps = 24;
constexpr double kGolden = 0.6180339887498949;
// Hann windows that overlap by half: neighbouring powers correlate by (1/6)².
constexpr double kOverlapVariance = 1.0 + 2.0 / 36.0;

class Likelihood {
 public:
  Likelihood(const ForcePowers& data, double force_power) : data_(data), x_(data.force_N.size()), falls_(x_.size()) {
    for (std::size_t j = 0; j < x_.size(); ++j) x_[j] = (std::pow(data.force_N[j], force_power) - 1.0) / force_power;
  }

  // The deviance with the best scale for that g.
  double deviance(double g) {
    scale_ = 0.0;
    for (std::size_t j = 0; j < x_.size(); ++j) {
      falls_[j] = std::exp(-2.0 * g * x_[j]);
      scale_ += std::max(data_.power[j] - data_.noise[j], kLeastPart * data_.power[j]) / falls_[j];
    }
    scale_ /= static_cast<double>(x_.size());
    for (int step = 0; step < kScaleSteps; ++step) {
      double sum = 0.0, weights = 0.0;
      for (std::size_t j = 0; j < x_.size(); ++j) {
        const double weight = falls_[j] / expected(j);
        sum += weight * weight * (data_.power[j] - data_.noise[j]) / falls_[j];
        weights += weight * weight;
      }
      const double next = std::max(sum / weights, 0.3 * scale_);
      const bool converged = std::abs(next - scale_) <= 1e-9 * scale_;
      scale_ = next;
      if (converged) break;
    }
    double out = 0.0;
    for (std::size_t j = 0; j < x_.size(); ++j) out += std::log(expected(j)) + data_.power[j] / expected(j);
    return out;
  }

  ForceLaw at(double g) {
    ForceLaw out{g, 0.0, deviance(g), 0.0};
    double s0 = 0.0, s1 = 0.0, s2 = 0.0;
    for (std::size_t j = 0; j < x_.size(); ++j) {
      const double e = expected(j);
      out.dispersion += std::pow(data_.power[j] / e - 1.0, 2) / (static_cast<double>(x_.size()) - 2.0);
      const double weight = std::pow(scale_ * falls_[j] / e, 2);
      s0 += weight;
      s1 += weight * x_[j];
      s2 += weight * x_[j] * x_[j];
    }
    const double information = 4.0 * (s2 - s1 * s1 / s0);
    out.softness_stderr = information > 0.0 ? std::sqrt(kOverlapVariance * out.dispersion / information)
                                            : std::numeric_limits<double>::infinity();
    return out;
  }

 private:
  static constexpr double kLeastPart = 0.05;  // of a power that does not stand out of its noise

  double expected(std::size_t j) const { return scale_ * falls_[j] + data_.noise[j]; }

  const ForcePowers& data_;
  std::vector<double> x_, falls_;
  double scale_ = 0.0;
};

}  // namespace

ForceLaw fit_force_law(const ForcePowers& data, double force_power) {
  Likelihood likelihood(data, force_power);
  double best = kLowest, least = std::numeric_limits<double>::infinity();
  for (int i = 0; kLowest + i * kCoarse < kHighest + 0.5 * kCoarse; ++i) {
    const double g = kLowest + i * kCoarse;
    const double deviance = likelihood.deviance(g);
    if (deviance < least) least = deviance, best = g;
  }
  double low = best - kCoarse, high = best + kCoarse;
  for (int step = 0; step < kGoldenSteps; ++step) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (likelihood.deviance(a) < likelihood.deviance(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return likelihood.at(0.5 * (low + high));
}

}  // namespace asperity
