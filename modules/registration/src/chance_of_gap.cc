#include "asperity/registration/chance_of_gap.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace asperity {

double chance_of_gap(double best, std::vector<double> others) {
  constexpr std::size_t kLeast = 5, kMost = 10;
  if (others.size() < kLeast) return std::numeric_limits<double>::quiet_NaN();
  std::sort(others.begin(), others.end(), std::greater<>());
  others.resize(std::min(kMost, others.size()));
  const double gap = best - others.front();
  if (!(gap > 0.0)) return 1.0;
  double spacings = others.front() - others.back();
  for (const double value : others) spacings += value - others.back();
  if (!(spacings > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return std::pow(1.0 + gap / spacings, -static_cast<double>(others.size() - 1));
}

}  // namespace asperity
