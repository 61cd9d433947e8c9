#include "asperity/base/arrange_on_grid.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/nan.h"

namespace asperity {
namespace {

// Positions come rounded to a few digits, as in read_areal_map().
constexpr double kPositionTolerance_steps = 0.1;
constexpr std::size_t kMostMissing = 4;  // grid points for each point that is given

struct EvenAxis {
  double first_m = 0.0;
  double step_m = 0.0;
  std::size_t count = 0;

  std::optional<std::size_t> index_of(double position_m) const {
    const double steps = (position_m - first_m) / step_m;
    const double nearest = std::round(steps);
    if (!(std::abs(steps - nearest) <= kPositionTolerance_steps)) return std::nullopt;
    return static_cast<std::size_t>(nearest);
  }
};

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The axis of equal steps through all these positions. Whole rows or columns may be missing, so the step is the median
// of those between neighbours. Positions that differ by the rounding of floats are one.
std::optional<EvenAxis> even_axis(std::vector<double> positions_m, std::size_t points) {
  if (positions_m.empty()) return std::nullopt;
  std::sort(positions_m.begin(), positions_m.end());
  constexpr double kFloatRounding = 1e-7;
  const double length_m = positions_m.back() - positions_m.front();
  std::vector<double> steps_m;
  for (std::size_t i = 1; i < positions_m.size(); ++i) {
    const double step_m = positions_m[i] - positions_m[i - 1];
    if (step_m > kFloatRounding * length_m) steps_m.push_back(step_m);
  }
  if (steps_m.empty()) return std::nullopt;
  EvenAxis axis{positions_m.front(), median_of(std::move(steps_m)), 0};
  const double steps = std::round(length_m / axis.step_m);
  if (!(steps >= 1.0) || steps >= static_cast<double>(kMostMissing * points)) return std::nullopt;
  axis.step_m = length_m / steps;
  axis.count = static_cast<std::size_t>(steps) + 1;
  return axis;
}

// Points are missing at the end of the last row or column alone: not gaps of a measurement but a file that was cut off.
bool is_cut_off(const std::vector<bool>& taken, std::size_t columns, std::size_t rows) {
  const auto missing = static_cast<std::size_t>(std::count(taken.begin(), taken.end(), false));
  if (missing == 0) return false;
  const auto last_are_missing = [&](auto index_of) {
    for (std::size_t i = 0; i < missing; ++i) {
      if (taken[index_of(taken.size() - 1 - i)]) return false;
    }
    return true;
  };
  return last_are_missing([](std::size_t i) { return i; }) ||
         last_are_missing([&](std::size_t i) { return i % rows * columns + i / rows; });
}

}  // namespace

std::optional<ArealMap> arrange_on_grid(const std::vector<std::array<double, 3>>& points_m) {
  std::vector<double> x_m, y_m;
  for (const auto& point : points_m) x_m.push_back(point[0]), y_m.push_back(point[1]);
  const auto x = even_axis(std::move(x_m), points_m.size());
  const auto y = even_axis(std::move(y_m), points_m.size());
  if (!x || !y || x->count > kMostMissing * points_m.size() / y->count) return std::nullopt;
  ArealMap map{x->step_m, y->step_m, x->count, y->count, std::vector<double>(x->count * y->count, kNan)};
  std::vector<bool> taken(map.height_m.size());
  for (const auto& point : points_m) {
    const auto column = x->index_of(point[0]), row = y->index_of(point[1]);
    if (!column || !row || taken[*row * map.columns + *column]) return std::nullopt;
    taken[*row * map.columns + *column] = true;
    map.height_m[*row * map.columns + *column] = point[2];
  }
  if (is_cut_off(taken, map.columns, map.rows)) return std::nullopt;
  return map;
}

}  // namespace asperity
