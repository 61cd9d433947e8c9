#include "texture_tear.h"

#include <algorithm>
#include <cmath>

#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

using Eigen::Vector2d;

constexpr double kOfTheEdge = 1e-4;
constexpr double kOfTheCoordinates = 1e-6;

}  // namespace

bool is_torn(const RenderTexture& texture, const std::array<Vector2d, 2>& a_m, const std::array<Vector2d, 2>& b_m) {
  if (!is_height_field(texture.texture.model) || is_series(texture.model)) return false;
  const HeightPeriods periods = height_periods_m(texture.texture.model);
  const Vector2d period_m(periods.x_m, periods.y_m);
  const double edge_m = std::max((a_m[1] - a_m[0]).norm(), (b_m[1] - b_m[0]).norm());
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    if (period_m[axis] == 0.0) continue;
    const double first_m = b_m[0][axis] - a_m[0][axis];
    const double whole_m = std::isfinite(period_m[axis]) ? period_m[axis] * std::round(first_m / period_m[axis]) : 0.0;
    for (std::size_t end = 0; end < 2; ++end) {
      const double size_m = std::max(std::abs(a_m[end][axis]), std::abs(b_m[end][axis]));
      if (std::abs(b_m[end][axis] - a_m[end][axis] - whole_m) > kOfTheEdge * edge_m + kOfTheCoordinates * size_m)
        return true;
    }
  }
  return false;
}

}  // namespace asperity
