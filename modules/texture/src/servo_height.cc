#include "asperity/texture/servo_tables.h"

#include <cmath>
#include <cstring>

#include "asperity/base/processor.h"
#include "asperity/texture/evaluate_height_map.h"
#include "asperity/texture/evaluate_spline_grid.h"

namespace asperity {
namespace {

// Four columns side by side; the compiler makes one or two registers of them.
using Lanes [[gnu::vector_size(32)]] = double;
using IntLanes [[gnu::vector_size(16)]] = std::int32_t;
using LevelLanes [[gnu::vector_size(8)]] = std::uint16_t;

// A cubic in t for each of four neighbours, and its derivative.
struct Cubics {
  Lanes c0, c1, c2, c3;
};

// Keys 1981, a = −1/2: through the values.
constexpr Cubics kKeys{{0.0, 1.0, 0.0, 0.0}, {-0.5, 0.0, 0.5, 0.0}, {1.0, -2.5, 2.0, -0.5}, {-0.5, 1.5, -1.5, 0.5}};
// The uniform cubic B-splines over a cell.
constexpr Cubics kSpline{{1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0},
                         {-0.5, 0.0, 0.5, 0.0},
                         {0.5, -1.0, 0.5, 0.0},
                         {-1.0 / 6.0, 0.5, -0.5, 1.0 / 6.0}};

// Where four neighbours lie side by side: the first of them, and how far the point is past the second.
struct Place {
  std::size_t first = 0;
  double t = 0.0;
};

[[gnu::always_inline]] inline bool inside(double u, std::size_t count, Border border, Place& place) noexcept {
  const double v = u - 0.5;
  if (!(std::abs(v) < 0x1p30)) return false;
  const Cell nearest = nearest_cell(v);
  auto cell = static_cast<std::int32_t>(nearest.number);
  const auto size = static_cast<std::int32_t>(count);
  if (border == Border::kPeriodic && (cell < 0 || cell >= size)) {
    cell %= size;
    if (cell < 0) cell += size;
  }
  // The blends at the border of SplineGrid and HeightMap reach one cell inwards, of the spline's whole cells.
  if (cell < 3 || cell >= size - 4) return false;
  place = {static_cast<std::size_t>(cell - 1), nearest.t + 0.5};
  return true;
}

[[gnu::always_inline]] inline void load(const double* from, Lanes& to) noexcept { std::memcpy(&to, from, sizeof to); }

[[gnu::always_inline]] inline void load(const std::uint16_t* from, Lanes& to) noexcept {
  LevelLanes levels;
  std::memcpy(&levels, from, sizeof levels);
  to = __builtin_convertvector(__builtin_convertvector(levels, IntLanes), Lanes);
}

// Sixteen values and their cubics; slopes a cell.
template <class Value>
[[gnu::always_inline]] inline HeightAndGradient patch(const Value* first, std::size_t columns, const Cubics& cubics,
                                                      double tx, double ty) noexcept {
  const double tx2 = tx * tx;
  const double ty2 = ty * ty;
  const Lanes x = (cubics.c0 + cubics.c1 * tx) + (cubics.c2 + cubics.c3 * tx) * tx2;
  const Lanes dx = (cubics.c1 + 2.0 * cubics.c2 * tx) + 3.0 * cubics.c3 * tx2;
  const Lanes y = (cubics.c0 + cubics.c1 * ty) + (cubics.c2 + cubics.c3 * ty) * ty2;
  const Lanes dy = (cubics.c1 + 2.0 * cubics.c2 * ty) + 3.0 * cubics.c3 * ty2;
  Lanes row[4];
  for (std::size_t r = 0; r < 4; ++r) load(first + r * columns, row[r]);
  const Lanes height = (row[0] * y[0] + row[1] * y[1]) + (row[2] * y[2] + row[3] * y[3]);
  const Lanes slope = (row[0] * dy[0] + row[1] * dy[1]) + (row[2] * dy[2] + row[3] * dy[3]);
  const Lanes h = x * height;
  const Lanes hx = dx * height;
  const Lanes hy = x * slope;
  return {(h[0] + h[1]) + (h[2] + h[3]), (hx[0] + hx[1]) + (hx[2] + hx[3]), (hy[0] + hy[1]) + (hy[2] + hy[3])};
}

template <class Grid, class Value>
[[gnu::always_inline]] inline HeightAndGradient grid_height(const Grid& grid, const Value* values, const Cubics& cubics,
                                                            const GridScale& scale, double x_m, double y_m) noexcept {
  Place x, y;
  if (!inside((x_m - scale.origin_x_m) * scale.cells_x_per_m, grid.columns, grid.border, x) ||
      !inside((y_m - scale.origin_y_m) * scale.cells_y_per_m, grid.rows, grid.border, y)) {
    return evaluate_height(grid, x_m, y_m);
  }
  const HeightAndGradient h = patch(values + y.first * grid.columns + x.first, grid.columns, cubics, x.t, y.t);
  return {scale.low_m + scale.unit_m * h.height_m, scale.unit_m * scale.cells_x_per_m * h.slope_x,
          scale.unit_m * scale.cells_y_per_m * h.slope_y};
}

ASPERITY_TARGET_AVX2 HeightAndGradient map_height_avx2(const HeightMap& map, const GridScale& scale, double x_m,
                                                       double y_m) noexcept {
  return grid_height(map, map.level.data(), kKeys, scale, x_m, y_m);
}

ASPERITY_TARGET_AVX2 HeightAndGradient spline_height_avx2(const SplineGrid& grid, const GridScale& scale, double x_m,
                                                          double y_m) noexcept {
  return grid_height(grid, grid.coefficient_m.data(), kSpline, scale, x_m, y_m);
}

}  // namespace

HeightAndGradient map_height(const HeightMap& map, const GridScale& scale, double x_m, double y_m) noexcept {
  if (kProcessorHasAvx2) return map_height_avx2(map, scale, x_m, y_m);
  return grid_height(map, map.level.data(), kKeys, scale, x_m, y_m);
}

HeightAndGradient spline_height(const SplineGrid& grid, const GridScale& scale, double x_m, double y_m) noexcept {
  if (kProcessorHasAvx2) return spline_height_avx2(grid, scale, x_m, y_m);
  return grid_height(grid, grid.coefficient_m.data(), kSpline, scale, x_m, y_m);
}

}  // namespace asperity
