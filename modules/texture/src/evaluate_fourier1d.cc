#include "asperity/texture/evaluate_fourier1d.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "asperity/base/processor.h"

namespace asperity {
namespace {

// Between `low_m` and `high_m` the slope goes from falling to rising: bisects for its zero.
double valley_m(const Fourier1d& texture, double low_m, double high_m) {
  for (int i = 0; i < 60; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    (evaluate_height(texture, middle_m).slope < 0.0 ? low_m : high_m) = middle_m;
  }
  return evaluate_height(texture, 0.5 * (low_m + high_m)).height_m;
}

// x / L less whole periods, as the sum of two doubles: the angle of harmonic 4096 is then as exact as that of
// the first.
struct Turns {
  double high = 0.0;
  double low = 0.0;

  // n times it, less whole turns.
  double multiple(std::size_t n) const noexcept {
    const double factor = static_cast<double>(n);
    const double product = factor * high;
    const double rest = std::fma(factor, high, -product);
    return (product - std::floor(product)) + (rest + factor * low);
  }
};

Turns turns_of(double x_m, double length_mm) noexcept {
  const double x_mm = x_m * 1e3;
  const double x_rest_mm = std::fma(x_m, 1e3, -x_mm);
  const double turns = x_mm / length_mm;
  const double rest = (std::fma(-turns, length_mm, x_mm) + x_rest_mm) / length_mm;
  return {turns - std::floor(turns), rest};
}

template <std::size_t Count>
double total(const std::array<double, Count>& lanes) noexcept {
  double even = 0.0;
  double odd = 0.0;
  for (std::size_t k = 0; k < Count; k += 2) even += lanes[k], odd += lanes[k + 1];
  return even + odd;
}

// Eight harmonics at a time, in the same order whatever the instruction set: the same bits everywhere.
[[gnu::always_inline]] inline HeightAndSlope sum_series(const Fourier1d& texture, double x_m) noexcept {
  constexpr std::size_t kLanes = 8;
  constexpr std::size_t kAnchor = 128;  // harmonics between settings anew
  using Lanes = std::array<double, kLanes>;
  const Turns turn = turns_of(x_m, texture.length_mm);
  // e^(iθ) to e^(8iθ), by halving: each is two rounded products off at most three times.
  Lanes cos_lane, sin_lane;
  {
    const double theta = 2.0 * std::numbers::pi * turn.high;
    cos_lane[0] = std::cos(theta);
    sin_lane[0] = std::sin(theta);
    for (std::size_t k = 1; k < kLanes; ++k) {
      const std::size_t p = (k + 1) / 2 - 1;
      const std::size_t q = k - 1 - p;
      cos_lane[k] = cos_lane[p] * cos_lane[q] - sin_lane[p] * sin_lane[q];
      sin_lane[k] = sin_lane[p] * cos_lane[q] + cos_lane[p] * sin_lane[q];
    }
  }
  const double cos_turn = cos_lane[kLanes - 1];
  const double sin_turn = sin_lane[kLanes - 1];
  const double* a = texture.a_m.data();
  const double* b = texture.b_m.data();
  const std::size_t count = texture.a_m.size();
  Lanes sum{}, derivative{};
  Lanes cos_j, sin_j, number;
  for (std::size_t start = 0; start < count; start += kAnchor) {
    // The lanes hold the harmonics start + 1 … start + 8 of an angle that is exact to rounding.
    const double angle = 2.0 * std::numbers::pi * turn.multiple(start);
    const double cos_start = std::cos(angle);
    const double sin_start = std::sin(angle);
    for (std::size_t k = 0; k < kLanes; ++k) {
      cos_j[k] = cos_start * cos_lane[k] - sin_start * sin_lane[k];
      sin_j[k] = sin_start * cos_lane[k] + cos_start * sin_lane[k];
      number[k] = static_cast<double>(start + k + 1);
    }
    const std::size_t end = std::min(start + kAnchor, count);
    std::size_t j = start;
    for (; j + kLanes <= end; j += kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        sum[k] += a[j + k] * cos_j[k] + b[j + k] * sin_j[k];
        derivative[k] += number[k] * (b[j + k] * cos_j[k] - a[j + k] * sin_j[k]);
        const double next = cos_j[k] * cos_turn - sin_j[k] * sin_turn;
        sin_j[k] = sin_j[k] * cos_turn + cos_j[k] * sin_turn;
        cos_j[k] = next;
        number[k] += static_cast<double>(kLanes);
      }
    }
    for (std::size_t k = 0; j < end; ++j, ++k) {
      sum[k] += a[j] * cos_j[k] + b[j] * sin_j[k];
      derivative[k] += number[k] * (b[j] * cos_j[k] - a[j] * sin_j[k]);
    }
  }
  const double height_m = texture.mean_m + total(sum);
  return {height_m, total(derivative) * texture.omega_rad_per_mm() * 1e3};
}

ASPERITY_TARGET_AVX2 HeightAndSlope sum_series_avx2(const Fourier1d& texture, double x_m) noexcept {
  return sum_series(texture, x_m);
}

}  // namespace

HeightAndSlope evaluate_height(const Fourier1d& texture, double x_m) noexcept {
  if (kProcessorHasAvx2) return sum_series_avx2(texture, x_m);
  return sum_series(texture, x_m);
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
  for (std::size_t i = 0; i < count; ++i) grid[i] = evaluate_height(texture, static_cast<double>(i) * step_m);
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

double height_offset_m(const Fourier1d& texture) { return -lowest_height_m(texture); }

}  // namespace asperity
