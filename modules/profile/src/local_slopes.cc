#include "local_slopes.h"

#include <cmath>

#include "asperity/base/nan.h"

namespace asperity {

void local_slopes(const double* height, std::size_t count, std::size_t stride, double spacing, double* slope) {
  const auto n = static_cast<std::ptrdiff_t>(count);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const auto z = [&](std::ptrdiff_t offset) {
      const std::ptrdiff_t at = i + offset;
      return at < 0 || at >= n ? kNan : height[static_cast<std::size_t>(at) * stride];
    };
    double& out = slope[static_cast<std::size_t>(i) * stride];
    out = kNan;
    if (std::isnan(z(0))) continue;
    const double seven = (z(3) - 9.0 * z(2) + 45.0 * z(1) - 45.0 * z(-1) + 9.0 * z(-2) - z(-3)) / 60.0;
    double step = seven;
    if (std::isnan(step)) step = 0.5 * (z(1) - z(-1));
    if (std::isnan(step)) step = z(1) - z(0);
    if (std::isnan(step)) step = z(0) - z(-1);
    out = step / spacing;
  }
}

std::vector<double> local_slopes(std::span<const double> height, double spacing) {
  std::vector<double> out(height.size());
  local_slopes(height.data(), height.size(), 1, spacing, out.data());
  return out;
}

}  // namespace asperity
