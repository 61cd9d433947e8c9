#include "asperity/texture/evaluate_fourier1d.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace asperity {
namespace {

// Between `low_m` and `high_m` the slope goes from falling to rising: bisects for its zero.
double valley_m(const Fourier1d& texture, double low_m, double high_m) {
  for (int i = 0; i < 60; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    (evaluate(texture, middle_m).slope < 0.0 ? low_m : high_m) = middle_m;
  }
  return evaluate(texture, 0.5 * (low_m + high_m)).height_m;
}

}  // namespace

HeightAndSlope evaluate(const Fourier1d& texture, double x_m) noexcept {
  // Whole periods go first: the sine of a large argument would lose digits.
  const double periods = x_m * 1e3 / texture.length_mm;
  const double theta = 2.0 * std::numbers::pi * (periods - std::floor(periods));
  const double cos_1 = std::cos(theta);
  const double sin_1 = std::sin(theta);
  double cos_j = cos_1;
  double sin_j = sin_1;
  double sum = 0.0;
  double derivative = 0.0;
  for (std::size_t j = 0; j < texture.a_m.size(); ++j) {
    sum += texture.a_m[j] * cos_j + texture.b_m[j] * sin_j;
    derivative += static_cast<double>(j + 1) * (texture.b_m[j] * cos_j - texture.a_m[j] * sin_j);
    const double next = cos_j * cos_1 - sin_j * sin_1;
    sin_j = sin_j * cos_1 + cos_j * sin_1;
    cos_j = next;
  }
  return {texture.mean_m + sum, derivative * texture.omega_rad_per_mm() * 1e3};
}

double lowest_height_m(const Fourier1d& texture) {
  if (texture.a_m.empty()) return texture.mean_m;
  const std::size_t count = 16 * texture.a_m.size();
  const double step_m = texture.length_mm * 1e-3 / static_cast<double>(count);
  double curvature = 0.0;  // bounds |g''|, 1/m
  for (std::size_t j = 0; j < texture.a_m.size(); ++j) {
    const double k = static_cast<double>(j + 1) * texture.omega_rad_per_mm() * 1e3;
    curvature += k * k * std::hypot(texture.a_m[j], texture.b_m[j]);
  }
  std::vector<HeightAndSlope> grid(count + 1);
  for (std::size_t i = 0; i < count; ++i) grid[i] = evaluate(texture, static_cast<double>(i) * step_m);
  grid[count] = grid[0];
  double lowest = std::min_element(grid.begin(), grid.end(), [](const auto& a, const auto& b) {
                    return a.height_m < b.height_m;
                  })->height_m;
  // A valley between two grid points is at most this much below the lower of them.
  const double margin_m = 0.5 * curvature * step_m * step_m;
  const double reach_m = lowest + margin_m;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::min(grid[i].height_m, grid[i + 1].height_m) > reach_m || grid[i].slope >= 0.0 || grid[i + 1].slope <= 0.0)
      continue;
    lowest = std::min(lowest, valley_m(texture, static_cast<double>(i) * step_m, static_cast<double>(i + 1) * step_m));
  }
  return lowest;
}

double lift_m(const Fourier1d& texture) { return -lowest_height_m(texture); }

}  // namespace asperity
