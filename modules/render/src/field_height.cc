#include "field_height.h"

#include <array>

#include "asperity/texture/evaluate_height_map.h"
#include "asperity/texture/evaluate_spline_grid.h"

namespace asperity {
namespace {

struct Weights {
  std::array<double, 4> weight;
  std::array<double, 4> slope;  // a cell
};

// Keys 1981, a = −1/2: through the values.
Weights keys_weights(double t) noexcept {
  const double s = 1.0 - t;
  return {{-0.5 * t * s * s, 1.0 + t * t * (1.5 * t - 2.5), 1.0 + s * s * (1.5 * s - 2.5), -0.5 * s * t * t},
          {-0.5 * s * (s - 2.0 * t), t * (4.5 * t - 5.0), -s * (4.5 * s - 5.0), 0.5 * t * (t - 2.0 * s)}};
}

Weights spline_weights(double t) noexcept {
  constexpr double kSixth = 1.0 / 6.0;
  const double s = 1.0 - t;
  const double tt = t * t;
  const double ss = s * s;
  return {{kSixth * (s * ss), kSixth * (4.0 - 3.0 * tt * (1.0 + s)), kSixth * (4.0 - 3.0 * ss * (1.0 + t)),
           kSixth * (t * tt)},
          {-0.5 * ss, 1.5 * tt - 2.0 * t, 2.0 * s - 1.5 * ss, 0.5 * tt}};
}

// Where four neighbours lie side by side: the first of them, and how far the point is past the second.
struct Place {
  std::size_t first = 0;
  double t = 0.0;
};

bool inside(double u, std::size_t count, Border border, Place& place) noexcept {
  const double v = u - 0.5;
  if (!(std::abs(v) < 0x1p31)) return false;
  const Cell nearest = nearest_cell(v);
  auto cell = static_cast<std::int64_t>(static_cast<std::int32_t>(nearest.number));
  const auto size = static_cast<std::int64_t>(count);
  if (border == Border::kPeriodic && (cell < 0 || cell >= size)) {
    cell %= size;
    if (cell < 0) cell += size;
  }
  // The blends at the border of SplineGrid and HeightMap reach one cell inwards, of the spline's whole cells.
  if (cell < 3 || cell >= size - 4) return false;
  place = {static_cast<std::size_t>(cell - 1), nearest.t + 0.5};
  return true;
}

template <class Value>
HeightAndGradient patch(const Value* first, std::size_t columns, const Weights& x, const Weights& y) noexcept {
  // Rows first: each of these is four columns wide and waits for nothing but the weights along y.
  std::array<double, 4> height{};
  std::array<double, 4> slope{};
  for (std::size_t r = 0; r < 4; ++r) {
    const Value* row = first + r * columns;
    for (std::size_t c = 0; c < 4; ++c) {
      const auto value = static_cast<double>(row[c]);
      height[c] += y.weight[r] * value;
      slope[c] += y.slope[r] * value;
    }
  }
  const auto along_x = [](const std::array<double, 4>& w, const std::array<double, 4>& v) {
    return (w[0] * v[0] + w[1] * v[1]) + (w[2] * v[2] + w[3] * v[3]);
  };
  return {along_x(x.weight, height), along_x(x.slope, height), along_x(x.weight, slope)};
}

}  // namespace

HeightAndGradient map_height(const HeightMap& map, double x_m, double y_m) noexcept {
  const double pixels_x_per_m = 1e3 / map.mm_per_px_x;
  const double pixels_y_per_m = 1e3 / map.mm_per_px_y;
  Place x, y;
  if (!inside(x_m * pixels_x_per_m, map.columns, map.border, x) ||
      !inside(y_m * pixels_y_per_m, map.rows, map.border, y))
    return evaluate(map, x_m, y_m);
  const HeightAndGradient levels =
      patch(map.level.data() + y.first * map.columns + x.first, map.columns, keys_weights(x.t), keys_weights(y.t));
  const double unit_m = map.metres_per_level();
  return {map.low_m + unit_m * levels.height_m, unit_m * pixels_x_per_m * levels.slope_x,
          unit_m * pixels_y_per_m * levels.slope_y};
}

HeightAndGradient spline_height(const SplineGrid& grid, double x_m, double y_m) noexcept {
  const double cells_x_per_m = 1.0 / grid.spacing_x_m;
  const double cells_y_per_m = 1.0 / grid.spacing_y_m;
  Place x, y;
  if (!inside((x_m - grid.origin_x_m) * cells_x_per_m, grid.columns, grid.border, x) ||
      !inside((y_m - grid.origin_y_m) * cells_y_per_m, grid.rows, grid.border, y)) {
    return evaluate(grid, x_m, y_m);
  }
  HeightAndGradient h = patch(grid.coefficient_m.data() + y.first * grid.columns + x.first, grid.columns,
                              spline_weights(x.t), spline_weights(y.t));
  h.slope_x *= cells_x_per_m;
  h.slope_y *= cells_y_per_m;
  return h;
}

}  // namespace asperity
