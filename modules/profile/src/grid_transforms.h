#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace asperity {

// Writes row `row` of a grid of real numbers into `values`, one a column.
using GridRow = std::function<void(std::size_t row, std::span<double> values)>;

// Σ over the pairs of points of a grid that are (dx, dy) apart of the product of their values, by Fourier transforms of
// real numbers with zeros beyond the grid (Wiener and Khinchin).
class LagSums {
 public:
  LagSums(std::size_t columns, std::size_t rows, const GridRow& row_of);

  // For |dx| ≤ columns/2 + 1 and 0 ≤ dy ≤ rows/2 + 1.
  double at(std::ptrdiff_t dx, std::size_t dy) const {
    return sums_[dy * (2 * reach_ + 1) + static_cast<std::size_t>(dx + static_cast<std::ptrdiff_t>(reach_))];
  }

 private:
  std::size_t reach_;  // along x
  std::vector<double> sums_;
};

// |X|² of a real grid's two-dimensional transform, for the columns 0 … columns/2, row by row: the rest is its mirror
// image.
std::vector<double> grid_power(std::size_t columns, std::size_t rows, const GridRow& row_of);

}  // namespace asperity
