#pragma once

#include <span>
#include <vector>

namespace asperity {

// Slopes of heights `spacing` apart, nan where a height is missing or stands alone. Where three heights are present on
// either side, of sixth order: (z₊₃ − 9 z₊₂ + 45 z₊₁ − 45 z₋₁ + 9 z₋₂ − z₋₃) / (60 spacing) (ISO 4287:1997, 4.1.4);
// nearer to ends and gaps (z₊₁ − z₋₁) / (2 spacing), at them the difference to the one neighbour.
std::vector<double> local_slopes(std::span<const double> height, double spacing);

// The same into `slope`.
void local_slopes(const double* height, std::size_t count, double spacing, double* slope);

// The same of one row's heights along the columns of a map, row by row.
void local_slopes_across(const double* height, std::size_t columns, std::size_t rows, std::size_t row, double spacing,
                         double* slope);

}  // namespace asperity
