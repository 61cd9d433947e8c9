#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "asperity/texture/fourier1d.h"

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

}  // namespace asperity
