#pragma once

#include <cstddef>
#include <vector>

namespace asperity {

// Heights on a rectangular grid, row by row (x runs fastest); nan where missing.
struct ArealMap {
  double x_spacing_m = 0.0;
  double y_spacing_m = 0.0;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<double> height_m;

  double at(std::size_t row, std::size_t column) const { return height_m[row * columns + column]; }
};

}  // namespace asperity
