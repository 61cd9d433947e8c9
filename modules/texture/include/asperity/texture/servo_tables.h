#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/fourier1d.h"
#include "asperity/texture/height_and_gradient.h"
#include "asperity/texture/height_map.h"
#include "asperity/texture/spline_grid.h"

namespace asperity {

// One cell of a table: Σ c_k t^k, t from −½ to ½ across the cell. A cache line.
struct alignas(64) TableCell {
  std::array<double, 8> c{};
};

// A Fourier series as polynomials over equal cells of a period, a power of two of them: degree 7, two-point Hermite.
// Cell i, the i-th of a period, reaches half a cell to either side of x = i h and has the series' height and first
// three derivatives at both ends, so that the table is C³. Within, h the cell's length (Birkhoff and Priver 1967, for
// this degree from the same kernel t⁴(1−t)⁴/8!):
//   |height − g| ≤ h⁸ max|g⁽⁸⁾| / 10321920,   |slope − g′| ≤ 3.69e-7 h⁷ max|g⁽⁸⁾|,   max|g⁽⁸⁾| ≤ Σ (jω)⁸ √(a_j² + b_j²)
struct PeriodicTable {
  double cells_per_m = 0.0;
  std::vector<TableCell> cells;  // empty: no table
};

// Reciprocals and units of an image or a spline grid, so that the servo thread does not divide.
struct GridScale {
  double cells_x_per_m = 0.0;
  double cells_y_per_m = 0.0;
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  double unit_m = 1.0;  // height of a value of 1
  double low_m = 0.0;   // height of a value of 0
};

// What a height field is evaluated by on the servo thread, made beforehand; each model fills what it uses.
struct ServoTables {
  PeriodicTable x_table;  // of a series, or of the factors of a product; empty: evaluated exactly
  PeriodicTable y_table;
  GridScale grid;  // of an image or a spline
};

inline constexpr std::size_t kMostTableCells = 1 << 17;  // 8 MiB

// The smallest table whose bounds are within half of the tolerances; the other half is for rounding. Empty if that
// would need more than kMostTableCells.
PeriodicTable make_periodic_table(const Fourier1d& series, double height_tolerance_m, double slope_tolerance);

// A coordinate in cells as the number of its cell, all but the last bits, and the place in the cell, −½ to ½. Adding
// 1.5·2⁵² leaves no bits of a fraction; for |u| < 2⁵¹.
struct Cell {
  std::uint64_t number = 0;
  double t = 0.0;
};
inline Cell nearest_cell(double u) noexcept {
  constexpr double kShift = 0x1.8p52;
  const double shifted = u + kShift;
  return {std::bit_cast<std::uint64_t>(shifted), u - (shifted - kShift)};
}

// The table at x_m, any x: the cells repeat by the last bits of their number. nan for an x that is not finite.
inline HeightAndSlope table_height(const PeriodicTable& table, double x_m) noexcept {
  double u = x_m * table.cells_per_m;
  // So far out a double has no fraction of a cell left.
  if (!(std::abs(u) < 0x1p51)) [[unlikely]] {
    u = std::fmod(u, static_cast<double>(table.cells.size()));
    if (!std::isfinite(u)) return {u, u};
  }
  const auto [number, t] = nearest_cell(u);
  const std::size_t last = table.cells.size() - 1;
  const auto& c = table.cells[static_cast<std::size_t>(number) & last].c;
  // In pairs: half as many steps wait for one another as in Horner's scheme.
  const double t2 = t * t;
  const double t4 = t2 * t2;
  const double height =
      ((c[0] + c[1] * t) + (c[2] + c[3] * t) * t2) + ((c[4] + c[5] * t) + (c[6] + c[7] * t) * t2) * t4;
  const double slope = ((c[1] + 2.0 * c[2] * t) + (3.0 * c[3] + 4.0 * c[4] * t) * t2) +
                       ((5.0 * c[5] + 6.0 * c[6] * t) + 7.0 * c[7] * t2) * t4;
  return {height, slope * table.cells_per_m};
}

// The same surfaces as evaluate_height() of the texture module, to rounding; faster where all sixteen values lie side
// by side in the image or grid, the same call at its border. nan for a position that is not finite.
HeightAndGradient map_height(const HeightMap& map, const GridScale& scale, double x_m, double y_m) noexcept;
HeightAndGradient spline_height(const SplineGrid& grid, const GridScale& scale, double x_m, double y_m) noexcept;

}  // namespace asperity
