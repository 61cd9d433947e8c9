#include "asperity/texture/evaluate_height_map.h"

#include <array>
#include <cmath>
#include <limits>

#include "asperity/base/nan.h"
#include "grid_patch.h"
#include "lowest_point.h"

namespace asperity {
namespace {

void cubic_weights(double t, std::array<double, 4>& weight, std::array<double, 4>& slope) noexcept {
  const double s = 1.0 - t;
  weight = {-0.5 * t * s * s, 1.0 + t * t * (1.5 * t - 2.5), 1.0 + s * s * (1.5 * s - 2.5), -0.5 * s * t * t};
  slope = {-0.5 * s * (s - 2.0 * t), t * (4.5 * t - 5.0), -s * (4.5 * s - 5.0), 0.5 * t * (t - 2.0 * s)};
}

PatchAxis along(double u, std::size_t count, Border border) noexcept {
  const double high = static_cast<double>(count) - (border == Border::kPeriodic ? 0.0 : 1.0);
  PatchAxis axis{};
  axis.at = to_inside(u, 0.0, high, border);
  const double cell = std::min(std::floor(axis.at.u), high - 1.0);
  axis.neighbours = neighbours(static_cast<std::ptrdiff_t>(cell) - 1, count, border);
  cubic_weights(axis.at.u - cell, axis.weight, axis.slope);
  return axis;
}

// At pixel coordinates, in levels; slopes a pixel.
HeightAndGradient evaluate_at(const HeightMap& map, double u, double v) noexcept {
  return sum_patch(along(u, map.columns, map.border), along(v, map.rows, map.border), map.level.data(), map.columns);
}

}  // namespace

HeightAndGradient evaluate_height(const HeightMap& map, double x_m, double y_m) noexcept {
  const double pixel_x_m = map.mm_per_px_x * 1e-3;
  const double pixel_y_m = map.mm_per_px_y * 1e-3;
  const double u = x_m / pixel_x_m;
  const double v = y_m / pixel_y_m;
  if (!std::isfinite(u) || !std::isfinite(v) || map.columns < 4 || map.rows < 4) return {kNan, kNan, kNan};
  const HeightAndGradient levels = evaluate_at(map, u, v);
  const double unit_m = map.metres_per_level();
  return {map.low_m + unit_m * levels.height_m, unit_m * levels.slope_x / pixel_x_m,
          unit_m * levels.slope_y / pixel_y_m};
}

double lowest_height_m(const HeightMap& map) {
  if (map.columns < 4 || map.rows < 4) return kNan;
  const double level = lowest_from_nodes(map.columns, map.rows, map.border == Border::kPeriodic,
                                         [&](double u, double v) { return evaluate_at(map, u, v).height_m; });
  return map.low_m + map.metres_per_level() * level;
}

}  // namespace asperity
