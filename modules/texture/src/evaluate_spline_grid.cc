#include "asperity/texture/evaluate_spline_grid.h"

#include <array>
#include <cmath>
#include <limits>

#include "asperity/base/nan.h"
#include "grid_patch.h"
#include "lowest_point.h"
#include "spline_weights.h"

namespace asperity {
namespace {

PatchAxis patch_axis(double u, std::size_t count, Border border) noexcept {
  const bool periodic = border == Border::kPeriodic;
  const double low = periodic ? 0.0 : 1.0;
  const double high = static_cast<double>(count) - (periodic ? 0.0 : 2.0);
  PatchAxis axis{};
  axis.at = to_inside(u, low, high, border);
  double cell = std::floor(axis.at.u);
  if (!periodic && cell > high - 1.0) cell = high - 1.0;
  axis.neighbours = neighbours(static_cast<std::ptrdiff_t>(cell) - 1, count, border);
  spline_weights(axis.at.u - cell, axis.weight, axis.slope);
  return axis;
}

// At grid coordinates; slopes a cell.
HeightAndGradient evaluate_at(const SplineGrid& grid, double u, double v) noexcept {
  return sum_patch(patch_axis(u, grid.columns, grid.border), patch_axis(v, grid.rows, grid.border),
                   grid.coefficient_m.data(), grid.columns);
}

}  // namespace

HeightAndGradient evaluate_height(const SplineGrid& grid, double x_m, double y_m) noexcept {
  const double u = (x_m - grid.origin_x_m) / grid.spacing_x_m;
  const double v = (y_m - grid.origin_y_m) / grid.spacing_y_m;
  if (!std::isfinite(u) || !std::isfinite(v) || grid.columns < 4 || grid.rows < 4) return {kNan, kNan, kNan};
  HeightAndGradient result = evaluate_at(grid, u, v);
  result.slope_x /= grid.spacing_x_m;
  result.slope_y /= grid.spacing_y_m;
  return result;
}

double lowest_height_m(const SplineGrid& grid) {
  if (grid.columns < 4 || grid.rows < 4) return kNan;
  return lowest_from_nodes(grid.columns, grid.rows, grid.border == Border::kPeriodic,
                           [&](double u, double v) { return evaluate_at(grid, u, v).height_m; });
}

}  // namespace asperity
