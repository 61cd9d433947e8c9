#include "surface_direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "asperity/base/nan.h"
#include "grid_transforms.h"

namespace asperity {
namespace {

constexpr int kDirections = 360;  // half a degree apart, over half a turn

// Autocorrelation at lags of up to half of the map, 1 at the origin.
class Autocorrelation {
 public:
  explicit Autocorrelation(const ArealMap& map)
      : map_(map), products_(products_of(map)), pairs_(pairs_of(map)), variance_(products_.at(0, 0) / pairs(0, 0)) {}

  // Between lags by straight lines along x and y; nan beyond half of the map or without pairs. y_m is not negative.
  double at(double x_m, double y_m) const {
    const double x = x_m / map_.x_spacing_m, y = y_m / map_.y_spacing_m;
    if (std::abs(x) > 0.5 * static_cast<double>(map_.columns) || std::abs(y) > 0.5 * static_cast<double>(map_.rows))
      return kNan;
    const double left = std::floor(x), top = std::floor(y);
    const auto node = [&](double column, double row) {
      const auto dx = static_cast<std::ptrdiff_t>(column);
      const auto dy = static_cast<std::size_t>(row);
      const double count = pairs(dx, dy);
      return count > 0.5 ? products_.at(dx, dy) / count / variance_ : kNan;
    };
    return std::lerp(std::lerp(node(left, top), node(left + 1, top), x - left),
                     std::lerp(node(left, top + 1), node(left + 1, top + 1), x - left), y - top);
  }

 private:
  static LagSums products_of(const ArealMap& map) {
    double scale = 0.0;
    for (const double z : map.height_m) scale = std::isnan(z) ? scale : std::max(scale, std::abs(z));
    return {map.columns, map.rows, [&map, scale](std::size_t row, std::span<double> line) {
              const double* z = &map.height_m[row * map.columns];
              for (std::size_t i = 0; i < line.size(); ++i) line[i] = std::isnan(z[i]) ? 0.0 : z[i] / scale;
            }};
  }

  // Without missing heights they are as many as the two grids have in common.
  static std::optional<LagSums> pairs_of(const ArealMap& map) {
    if (std::none_of(map.height_m.begin(), map.height_m.end(), [](double z) { return std::isnan(z); })) return {};
    return LagSums(map.columns, map.rows, [&map](std::size_t row, std::span<double> line) {
      const double* z = &map.height_m[row * map.columns];
      for (std::size_t i = 0; i < line.size(); ++i) line[i] = std::isnan(z[i]) ? 0.0 : 1.0;
    });
  }

  double pairs(std::ptrdiff_t dx, std::size_t dy) const {
    if (pairs_) return pairs_->at(dx, dy);
    const double columns = static_cast<double>(map_.columns) - std::abs(static_cast<double>(dx));
    return std::max(0.0, columns) * std::max(0.0, static_cast<double>(map_.rows) - static_cast<double>(dy));
  }

  const ArealMap& map_;
  LagSums products_;
  std::optional<LagSums> pairs_;
  double variance_;
};

// The first distance along a direction at which the autocorrelation falls to the threshold; nan if it does not.
double decay_m(const Autocorrelation& correlation, double angle, double step_m) {
  constexpr double kThreshold = 0.2;
  const double along_x = std::cos(angle), along_y = std::sin(angle);
  double before = 1.0;
  for (std::size_t i = 1;; ++i) {
    const double r_m = static_cast<double>(i) * step_m;
    const double here = correlation.at(r_m * along_x, r_m * along_y);
    if (std::isnan(here)) return kNan;
    if (here <= kThreshold) return r_m - step_m * (kThreshold - here) / (before - here);
    before = here;
  }
}

double hann(std::size_t i, std::size_t n) {
  return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
}

// Power by directions half a degree apart, each wave's spread over a Gaussian about its own.
class AngularPower {
 public:
  AngularPower() {
    for (int k = -kReach; k <= kReach; ++k) fall_[static_cast<std::size_t>(k + kReach)] = std::exp(-0.5 * k * k);
  }

  // The power of a wave at the angle atan2(fy, fx), 0 to a quarter turn, and that of its mirror image at −fx.
  void add(double angle, double sigma, double power, double mirrored_power) {
    if (sigma > kWidth) {
      add_wide(angle, sigma, power);
      add_wide(std::numbers::pi - angle, sigma, mirrored_power);
      return;
    }
    // exp(−(k + d)²/2) of whole k by two exponentials.
    const double at = angle / kWidth;
    const int nearest = static_cast<int>(std::lround(at));
    const double d = nearest - at, middle = std::exp(-0.5 * d * d) / kWidth, step = std::exp(-d);
    double factor = 1.0;
    for (int k = 0; k <= kReach; ++k, factor *= step) put(nearest, k, middle * factor, power, mirrored_power);
    factor = 1.0 / step;
    for (int k = -1; k >= -kReach; --k, factor /= step) put(nearest, k, middle * factor, power, mirrored_power);
  }

  // Of the maximum: the vertex of the parabola through it and its neighbours.
  double strongest_rad() const {
    const auto best = std::max_element(power_.begin(), power_.end()) - power_.begin();
    const auto at = [&](std::ptrdiff_t k) { return power_[static_cast<std::size_t>((k + kDirections) % kDirections)]; };
    const double here = at(best), before = at(best - 1), after = at(best + 1);
    const double bend = before - 2.0 * here + after;
    const double shift = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
    return (static_cast<double>(best) + shift) * kWidth;
  }

  static constexpr double kWidth = std::numbers::pi / kDirections;

 private:
  static constexpr int kReach = 3;  // sigmas

  void put(int nearest, int k, double weight, double power, double mirrored_power) {
    weight *= fall_[static_cast<std::size_t>(k + kReach)];
    power_[index(nearest + k)] += power * weight;
    power_[index(kDirections - nearest - k)] += mirrored_power * weight;
  }

  void add_wide(double angle, double sigma, double power) {
    const int reach = std::min(kDirections / 2, static_cast<int>(std::ceil(kReach * sigma / kWidth)));
    const int nearest = static_cast<int>(std::lround(angle / kWidth));
    for (int k = nearest - reach; k <= nearest + reach; ++k) {
      const double away = (k * kWidth - angle) / sigma;
      power_[index(k)] += power / sigma * std::exp(-0.5 * away * away);
    }
  }

  static std::size_t index(int k) { return static_cast<std::size_t>((k + 2 * kDirections) % kDirections); }

  std::array<double, kDirections> power_{};
  std::array<double, 2 * kReach + 1> fall_{};
};

// The direction of the waves with the most power, 0 to π.
double strongest_direction_rad(const ArealMap& map) {
  std::vector<double> taper(map.columns);
  for (std::size_t column = 0; column < map.columns; ++column) taper[column] = hann(column, map.columns);
  const std::vector<double> power = grid_power(map.columns, map.rows, [&](std::size_t row, std::span<double> line) {
    const double of_row = hann(row, map.rows);
    const double* z = &map.height_m[row * map.columns];
    for (std::size_t i = 0; i < line.size(); ++i) line[i] = std::isnan(z[i]) ? 0.0 : z[i] * of_row * taper[i];
  });
  const double x_step = 1.0 / (static_cast<double>(map.columns) * map.x_spacing_m);
  const double y_step = 1.0 / (static_cast<double>(map.rows) * map.y_spacing_m);
  const std::size_t width = map.columns / 2 + 1;
  AngularPower angular;
  for (std::size_t row = 0; row <= map.rows / 2; ++row) {
    const double* here = &power[row * width];
    const double* opposite = &power[(map.rows - row) % map.rows * width];  // of −fx, as X(−f) is the conjugate of X(f)
    const double fy = y_step * static_cast<double>(row);
    for (std::size_t column = 0; column < width; ++column) {
      const double fx = x_step * static_cast<double>(column);
      const double f = std::hypot(fx, fy);
      if (f < 1.5 * std::max(x_step, y_step)) continue;  // what the window makes of the mean
      // On the axes the opposite wave is the same one; of the shortest waves along an axis two directions give the same
      // heights, and each counts half.
      const bool is_alone = column == 0 || row == 0;
      const double share = !is_alone && (2 * column == map.columns || 2 * row == map.rows) ? 0.5 : 1.0;
      // A cell of the spectrum is as wide as half a step seen from the origin; half a degree at least.
      const double sigma = std::max(AngularPower::kWidth, 0.5 * std::max(x_step, y_step) / f);
      angular.add(std::atan2(fy, fx), sigma, share * here[column], is_alone ? 0.0 : share * opposite[column]);
    }
  }
  return angular.strongest_rad();
}

}  // namespace

CorrelationLengths correlation_lengths(const ArealMap& map) {
  CorrelationLengths out{std::numeric_limits<double>::infinity(), 0.0};
  const Autocorrelation correlation(map);
  const double step_m = 0.5 * std::min(map.x_spacing_m, map.y_spacing_m);
  for (int i = 0; i < kDirections; ++i) {
    const double r_m = decay_m(correlation, i * std::numbers::pi / kDirections, step_m);
    if (!std::isnan(r_m)) out.shortest_m = std::min(out.shortest_m, r_m);
    out.longest_m = std::isnan(r_m) || std::isnan(out.longest_m) ? kNan : std::max(out.longest_m, r_m);
  }
  if (!std::isfinite(out.shortest_m)) out.shortest_m = kNan;
  return out;
}

double lay_direction_rad(const ArealMap& map) {
  return std::fmod(strongest_direction_rad(map) + 0.5 * std::numbers::pi, std::numbers::pi);
}

}  // namespace asperity
