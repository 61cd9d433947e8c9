#include "local_slopes.h"

#include <cmath>

#include "asperity/base/nan.h"

namespace asperity {
namespace {

// Of whole neighbourhoods; `z` is at the height, its neighbours `stride` apart.
double seven_points(const double* z, std::ptrdiff_t stride) {
  return (z[3 * stride] - 9.0 * z[2 * stride] + 45.0 * z[stride] - 45.0 * z[-stride] + 9.0 * z[-2 * stride] -
          z[-3 * stride]) /
         60.0;
}

// The difference to be had with the fewest neighbours missing; `i` of `count` heights from `height` on.
double slope_step(const double* height, std::size_t count, std::size_t stride, std::size_t i) {
  const auto n = static_cast<std::ptrdiff_t>(count), here = static_cast<std::ptrdiff_t>(i);
  const auto z = [&](std::ptrdiff_t offset) {
    const std::ptrdiff_t at = here + offset;
    return at < 0 || at >= n ? kNan : height[static_cast<std::size_t>(at) * stride];
  };
  if (std::isnan(z(0))) return kNan;
  double step = kNan;
  if (here >= 3 && here + 3 < n) step = seven_points(height + i * stride, static_cast<std::ptrdiff_t>(stride));
  if (std::isnan(step)) step = 0.5 * (z(1) - z(-1));
  if (std::isnan(step)) step = z(1) - z(0);
  if (std::isnan(step)) step = z(0) - z(-1);
  return step;
}

}  // namespace

void local_slopes(const double* height, std::size_t count, double spacing, double* slope) {
  for (std::size_t i = 3; i + 3 < count; ++i) slope[i] = seven_points(height + i, 1) / spacing;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_inside = i >= 3 && i + 3 < count;
    if (!is_inside || std::isnan(slope[i]) || std::isnan(height[i]))
      slope[i] = slope_step(height, count, 1, i) / spacing;
  }
}

void local_slopes_across(const double* height, std::size_t columns, std::size_t rows, std::size_t row, double spacing,
                         double* slope) {
  const double* z = height + row * columns;
  const bool is_inside = row >= 3 && row + 3 < rows;
  if (is_inside) {
    for (std::size_t i = 0; i < columns; ++i)
      slope[i] = seven_points(z + i, static_cast<std::ptrdiff_t>(columns)) / spacing;
  }
  for (std::size_t i = 0; i < columns; ++i) {
    if (!is_inside || std::isnan(slope[i]) || std::isnan(z[i]))
      slope[i] = slope_step(height + i, rows, columns, row) / spacing;
  }
}

std::vector<double> local_slopes(std::span<const double> height, double spacing) {
  std::vector<double> out(height.size());
  local_slopes(height.data(), height.size(), spacing, out.data());
  return out;
}

}  // namespace asperity
