#include "asperity/profile/likely_compliance.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double kHardest_mm_per_N = 1e-3;
constexpr double kSoftest_mm_per_N = 1.0;
constexpr int kSteps = 2000;  // 0.35 % each

}  // namespace

LikelyCompliance likely_compliance(double measured_mm_per_N, double stderr_mm_per_N) {
  const bool measured = std::isfinite(measured_mm_per_N) && stderr_mm_per_N > 0.0 && std::isfinite(stderr_mm_per_N);
  const auto at = [](int i) {
    const double share = (static_cast<double>(i) + 0.5) / kSteps;
    return kHardest_mm_per_N * std::pow(kSoftest_mm_per_N / kHardest_mm_per_N, share);
  };
  const auto half_square = [&](double c) {
    return measured ? 0.5 * std::pow((c - measured_mm_per_N) / stderr_mm_per_N, 2) : 0.0;
  };
  // The likeliest has the weight 1: a measurement far beyond the limits is not lost in the smallest numbers.
  double least = half_square(at(0));
  for (int i = 1; i < kSteps; ++i) least = std::min(least, half_square(at(i)));
  double sum = 0.0, squares = 0.0, weights = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = at(i), weight = std::exp(least - half_square(c));
    sum += weight * c;
    squares += weight * c * c;
    weights += weight;
  }
  const double mean = sum / weights;
  return {mean, std::sqrt(std::max(0.0, squares / weights - mean * mean))};
}

}  // namespace asperity
