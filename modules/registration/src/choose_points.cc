#include "choose_points.h"

#include <algorithm>
#include <numeric>

namespace asperity::registration {

std::vector<std::uint32_t> choose_uniform(const PointSet& points, std::size_t count) {
  std::vector<std::uint32_t> out;
  if (count >= points.size() || points.s_m.back() <= 0.0) {
    out.resize(points.size());
    std::iota(out.begin(), out.end(), 0U);
    return out;
  }
  // The first point of each of `count` equal lengths.
  out.reserve(count);
  const double step_m = points.s_m.back() / static_cast<double>(count);
  double next_m = 0.5 * step_m;
  for (std::uint32_t i = 0; i < points.size() && out.size() < count; ++i) {
    if (points.s_m[i] < next_m) continue;
    out.push_back(i);
    next_m = std::max(next_m + step_m, points.s_m[i] + 0.5 * step_m);
  }
  return out;
}

}  // namespace asperity::registration
