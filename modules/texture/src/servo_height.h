#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/height_and_gradient.h"
#include "asperity/texture/height_map.h"
#include "asperity/texture/servo_tables.h"
#include "asperity/texture/spline_grid.h"

namespace asperity {

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

// The same surfaces as evaluate() of the texture module, to rounding; faster where all sixteen values lie side by side
// in the image or grid, the same call at its border. nan for a position that is not finite.
HeightAndGradient map_height(const HeightMap& map, const GridScale& scale, double x_m, double y_m) noexcept;
HeightAndGradient spline_height(const SplineGrid& grid, const GridScale& scale, double x_m, double y_m) noexcept;

}  // namespace asperity
