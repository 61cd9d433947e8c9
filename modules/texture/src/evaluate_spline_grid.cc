#include "asperity/texture/evaluate_spline_grid.h"

#include <array>
#include <cmath>
#include <limits>

#include "border.h"
#include "lowest_point.h"

namespace asperity {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The four cubic B-splines over a cell at t in [0, 1], and their derivatives.
void spline_weights(double t, std::array<double, 4>& weight, std::array<double, 4>& slope) noexcept {
  const double s = 1.0 - t;
  weight = {s * s * s / 6.0, (4.0 - 3.0 * t * t * (1.0 + s)) / 6.0, (4.0 - 3.0 * s * s * (1.0 + t)) / 6.0,
            t * t * t / 6.0};
  slope = {-0.5 * s * s, -2.0 * t + 1.5 * t * t, 2.0 * s - 1.5 * s * s, 0.5 * t * t};
}

struct Axis {
  Inside at;
  Neighbours neighbours;
  std::array<double, 4> weight;
  std::array<double, 4> slope;
};

Axis along(double u, std::size_t count, Border border) noexcept {
  const bool periodic = border == Border::kPeriodic;
  const double low = periodic ? 0.0 : 1.0;
  const double high = static_cast<double>(count) - (periodic ? 0.0 : 2.0);
  Axis axis{};
  axis.at = to_inside(u, low, high, border);
  double cell = std::floor(axis.at.u);
  if (!periodic && cell > high - 1.0) cell = high - 1.0;
  axis.neighbours = neighbours(static_cast<std::ptrdiff_t>(cell) - 1, count, border);
  spline_weights(axis.at.u - cell, axis.weight, axis.slope);
  return axis;
}

// At grid coordinates; slopes a cell.
HeightAndGradient evaluate_at(const SplineGrid& grid, double u, double v) noexcept {
  const Axis x = along(u, grid.columns, grid.border);
  const Axis y = along(v, grid.rows, grid.border);
  HeightAndGradient result;
  for (std::size_t r = 0; r < 4; ++r) {
    const double* row = grid.coefficient_m.data() + y.neighbours.index[r] * grid.columns;
    double height = 0.0;
    double slope = 0.0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double value = row[x.neighbours.index[c]];
      height += x.weight[c] * value;
      slope += x.slope[c] * value;
    }
    result.height_m += y.weight[r] * height;
    result.slope_x += y.weight[r] * slope;
    result.slope_y += y.slope[r] * height;
  }
  result.slope_x *= x.at.du;
  result.slope_y *= y.at.du;
  return result;
}

}  // namespace

HeightAndGradient evaluate(const SplineGrid& grid, double x_m, double y_m) noexcept {
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
