#include "biweight.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace asperity {

double biweight_limit(std::vector<double> distances) {
  if (distances.empty()) return 0.0;
  constexpr double kOfMedian = 4.4478;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return kOfMedian * *middle;
}

double least_biweight_limit(std::span<const double> heights) {
  constexpr double kRounding = 1e-10;
  double largest = 0.0;
  for (const double z : heights)
    if (std::isfinite(z)) largest = std::max(largest, std::abs(z));
  return kRounding * largest;
}

double biweight(double distance, double limit) {
  const double r = distance / limit;
  return std::abs(r) < 1.0 ? (1.0 - r * r) * (1.0 - r * r) : 0.0;
}

}  // namespace asperity
