#include "asperity/texture/evaluate_fourier1d.h"

#include <algorithm>
#include <array>
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
  // Four harmonics at a time: each turns by 4θ, so that the chain of dependent products is a quarter as long.
  constexpr std::size_t kLanes = 4;
  std::array<double, kLanes> cos_j, sin_j, sum{}, derivative{};
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    cos_j[lane] = std::cos(static_cast<double>(lane + 1) * theta);
    sin_j[lane] = std::sin(static_cast<double>(lane + 1) * theta);
  }
  const double cos_turn = cos_j[kLanes - 1];
  const double sin_turn = sin_j[kLanes - 1];
  const std::size_t count = texture.a_m.size();
  std::size_t j = 0;
  for (; j + kLanes <= count; j += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double a = texture.a_m[j + lane];
      const double b = texture.b_m[j + lane];
      sum[lane] += a * cos_j[lane] + b * sin_j[lane];
      derivative[lane] += static_cast<double>(j + lane + 1) * (b * cos_j[lane] - a * sin_j[lane]);
      const double next = cos_j[lane] * cos_turn - sin_j[lane] * sin_turn;
      sin_j[lane] = sin_j[lane] * cos_turn + cos_j[lane] * sin_turn;
      cos_j[lane] = next;
    }
  }
  for (std::size_t lane = 0; j < count; ++j, ++lane) {
    sum[lane] += texture.a_m[j] * cos_j[lane] + texture.b_m[j] * sin_j[lane];
    derivative[lane] += static_cast<double>(j + 1) * (texture.b_m[j] * cos_j[lane] - texture.a_m[j] * sin_j[lane]);
  }
  const double height_m = texture.mean_m + ((sum[0] + sum[1]) + (sum[2] + sum[3]));
  const double per_rad_m = (derivative[0] + derivative[1]) + (derivative[2] + derivative[3]);
  return {height_m, per_rad_m * texture.omega_rad_per_mm() * 1e3};
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
