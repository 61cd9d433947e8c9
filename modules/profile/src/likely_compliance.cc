#include "asperity/profile/likely_compliance.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double kHardest_mm_per_N = 1e-4;
constexpr double kSoftest_mm_per_N = 1.0;
constexpr int kSteps = 2600;  // 0.35 % each

}  // namespace

LikelyCompliance likely_compliance(double measured_mm_per_N, double stderr_mm_per_N, double degrees_of_freedom) {
  const bool measured = std::isfinite(measured_mm_per_N) && stderr_mm_per_N > 0.0 && std::isfinite(stderr_mm_per_N);
  const auto at = [](int i) {
    const double share = (static_cast<double>(i) + 0.5) / kSteps;
    return kHardest_mm_per_N * std::pow(kSoftest_mm_per_N / kHardest_mm_per_N, share);
  };
  const auto surprise = [&](double c) {  // −ln p
    if (!measured) return 0.0;
    const double square = std::pow((c - measured_mm_per_N) / stderr_mm_per_N, 2);
    return std::isfinite(degrees_of_freedom)
               ? 0.5 * (degrees_of_freedom + 1.0) * std::log1p(square / degrees_of_freedom)
               : 0.5 * square;
  };
  // The likeliest has the weight 1: a measurement far beyond the limits is not lost in the smallest numbers.
  double least = surprise(at(0));
  for (int i = 1; i < kSteps; ++i) least = std::min(least, surprise(at(i)));
  double sum = 0.0, squares = 0.0, weights = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = at(i), weight = std::exp(least - surprise(c));
    sum += weight * c;
    squares += weight * c * c;
    weights += weight;
  }
  const double mean = sum / weights;
  return {mean, std::sqrt(std::max(0.0, squares / weights - mean * mean))};
}

}  // namespace asperity
