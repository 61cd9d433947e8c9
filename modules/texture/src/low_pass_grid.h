#pragma once

#include <cstddef>
#include <vector>

#include "asperity/texture/spline_grid.h"

namespace asperity {

// Rows, then columns of a grid through low_pass_gain(), the cut-offs in cycles a cell; beyond its border the grid goes
// on as `border` says.
void low_pass_grid(std::vector<float>& values, std::size_t columns, std::size_t rows, Border border, double cutoff_x,
                   double cutoff_y);
void low_pass_grid(std::vector<double>& values, std::size_t columns, std::size_t rows, Border border, double cutoff_x,
                   double cutoff_y);

}  // namespace asperity
