#pragma once

#include <array>
#include <cstddef>

#include "asperity/texture/height_and_gradient.h"
#include "border.h"

namespace asperity {

// Four neighbours along one axis of a grid, with the weights of a cubic there and of its derivative.
struct PatchAxis {
  Inside at;
  Neighbours neighbours;
  std::array<double, 4> weight;
  std::array<double, 4> slope;
};

// The surface that 4 by 4 values span; slopes a cell. `values` are row by row.
template <class Value>
HeightAndGradient sum_patch(const PatchAxis& x, const PatchAxis& y, const Value* values, std::size_t columns) noexcept {
  HeightAndGradient result;
  for (std::size_t r = 0; r < 4; ++r) {
    const Value* row = values + y.neighbours.index[r] * columns;
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

}  // namespace asperity
