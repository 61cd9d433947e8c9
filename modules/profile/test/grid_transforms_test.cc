#include "grid_transforms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {
namespace {

struct Grid {
  std::size_t columns, rows;
  std::vector<double> values;

  Grid(std::size_t of_columns, std::size_t of_rows) : columns(of_columns), rows(of_rows) {
    Random random(columns * 100 + rows);
    for (std::size_t i = 0; i < columns * rows; ++i) values.push_back(random.normal());
  }
  GridRow row_of() const {
    return [this](std::size_t row, std::span<double> out) {
      for (std::size_t i = 0; i < columns; ++i) out[i] = values[row * columns + i];
    };
  }
};

// Odd, even and prime sizes, and the smallest.
const std::vector<Grid> kGrids{{2, 2}, {2, 3}, {9, 2}, {5, 7}, {13, 8}, {24, 17}};

TEST(LagSums, AreSumsOverPairs) {
  for (const Grid& grid : kGrids) {
    const LagSums sums(grid.columns, grid.rows, grid.row_of());
    const auto columns = static_cast<std::ptrdiff_t>(grid.columns), rows = static_cast<std::ptrdiff_t>(grid.rows);
    for (std::ptrdiff_t dy = 0; dy <= rows / 2 + 1; ++dy) {
      for (std::ptrdiff_t dx = -(columns / 2 + 1); dx <= columns / 2 + 1; ++dx) {
        double want = 0.0;
        for (std::ptrdiff_t y = 0; y + dy < rows; ++y) {
          for (std::ptrdiff_t x = 0; x < columns; ++x) {
            if (x + dx < 0 || x + dx >= columns) continue;
            want += grid.values[static_cast<std::size_t>(y * columns + x)] *
                    grid.values[static_cast<std::size_t>((y + dy) * columns + x + dx)];
          }
        }
        // Hundreds of terms near 1 and their rounding.
        EXPECT_NEAR(sums.at(dx, static_cast<std::size_t>(dy)), want, 1e-11)
            << grid.columns << 'x' << grid.rows << ' ' << dx << ' ' << dy;
      }
    }
  }
}

TEST(GridPower, IsThatOfTheTransformByItsDefinition) {
  for (const Grid& grid : kGrids) {
    const std::vector<double> power = grid_power(grid.columns, grid.rows, grid.row_of());
    const std::size_t width = grid.columns / 2 + 1;
    ASSERT_EQ(power.size(), width * grid.rows);
    for (std::size_t v = 0; v < grid.rows; ++v) {
      for (std::size_t u = 0; u < width; ++u) {
        std::complex<double> sum;
        for (std::size_t i = 0; i < grid.values.size(); ++i) {
          const double turns = static_cast<double>(u * (i % grid.columns)) / static_cast<double>(grid.columns) +
                               static_cast<double>(v * (i / grid.columns)) / static_cast<double>(grid.rows);
          sum += grid.values[i] * std::polar(1.0, -2.0 * std::numbers::pi * turns);
        }
        EXPECT_NEAR(power[v * width + u], std::norm(sum), 1e-10) << u << ' ' << v;
      }
    }
  }
}

}  // namespace
}  // namespace asperity
