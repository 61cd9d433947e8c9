#include "surface_direction.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include <unsupported/Eigen/FFT>

#include "asperity/base/nan.h"

namespace asperity {
namespace {

using Complex = std::complex<double>;
constexpr int kDirections = 360;  // half a degree apart, over half a turn

// Two-dimensional transform in place, rows then columns; the inverse has its factor. Columns are taken out some at a
// time, so that what is read of a row is read once.
void transform(std::vector<Complex>& x, std::size_t columns, std::size_t rows, bool inverse) {
  Eigen::FFT<double> fft;
  std::vector<Complex> line, out;
  const auto run = [&] { inverse ? fft.inv(out, line) : fft.fwd(out, line); };
  for (std::size_t row = 0; row < rows; ++row) {
    line.assign(&x[row * columns], &x[row * columns] + columns);
    run();
    std::copy(out.begin(), out.end(), &x[row * columns]);
  }
  constexpr std::size_t kTogether = 16;
  std::vector<std::vector<Complex>> block(kTogether, std::vector<Complex>(rows));
  for (std::size_t first = 0; first < columns; first += kTogether) {
    const std::size_t count = std::min(kTogether, columns - first);
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t c = 0; c < count; ++c) block[c][row] = x[row * columns + first + c];
    for (std::size_t c = 0; c < count; ++c) {
      line.swap(block[c]);
      run();
      line.swap(block[c]);
      block[c].swap(out);
      out.resize(rows);
    }
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t c = 0; c < count; ++c) x[row * columns + first + c] = block[c][row];
  }
}

std::size_t padded_size(std::size_t n) {
  std::size_t out = 1;
  while (out < n + n / 2 + 2) out *= 2;
  return out;
}

// Autocorrelation at lags of up to half of the map, 1 at the origin.
class Autocorrelation {
 public:
  explicit Autocorrelation(const ArealMap& map)
      : map_(map), columns_(padded_size(map.columns)), rows_(padded_size(map.rows)), values_(columns_ * rows_) {
    // Heights and presence are the real and the imaginary part of one transform, and so are their correlations.
    double scale = 0.0;
    for (const double z : map.height_m) scale = std::isnan(z) ? scale : std::max(scale, std::abs(z));
    for (std::size_t row = 0; row < map.rows; ++row) {
      for (std::size_t column = 0; column < map.columns; ++column) {
        const double z = map.at(row, column);
        if (!std::isnan(z)) values_[row * columns_ + column] = Complex(z / scale, 1.0);
      }
    }
    transform(values_, columns_, rows_, false);
    std::vector<Complex> power(values_.size());
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column) {
        const Complex here = values_[row * columns_ + column];
        const Complex mirrored = std::conj(values_[(rows_ - row) % rows_ * columns_ + (columns_ - column) % columns_]);
        power[row * columns_ + column] = Complex(0.25 * std::norm(here + mirrored), 0.25 * std::norm(here - mirrored));
      }
    }
    values_ = std::move(power);
    transform(values_, columns_, rows_, true);
    variance_ = values_[0].real() / values_[0].imag();
  }

  // Between lags by straight lines along x and y; nan beyond half of the map or without pairs.
  double at(double x_m, double y_m) const {
    const double x = x_m / map_.x_spacing_m, y = y_m / map_.y_spacing_m;
    if (std::abs(x) > 0.5 * static_cast<double>(map_.columns) || std::abs(y) > 0.5 * static_cast<double>(map_.rows))
      return kNan;
    const double left = std::floor(x), top = std::floor(y);
    const auto node = [&](double column, double row) {
      const auto wrap = [](double lag, std::size_t size) {
        const auto n = static_cast<std::ptrdiff_t>(size);
        return static_cast<std::size_t>((static_cast<std::ptrdiff_t>(lag) % n + n) % n);
      };
      const Complex sums = values_[wrap(row, rows_) * columns_ + wrap(column, columns_)];
      return sums.imag() > 0.5 ? sums.real() / sums.imag() / variance_ : kNan;
    };
    return std::lerp(std::lerp(node(left, top), node(left + 1, top), x - left),
                     std::lerp(node(left, top + 1), node(left + 1, top + 1), x - left), y - top);
  }

 private:
  const ArealMap& map_;
  std::size_t columns_, rows_;
  std::vector<Complex> values_;
  double variance_ = 0.0;
};

// The first distance along a direction at which the autocorrelation falls to the threshold; nan if it does not.
double decay_m(const Autocorrelation& correlation, double angle, double step_m) {
  constexpr double kThreshold = 0.2;
  double before = 1.0;
  for (std::size_t i = 1;; ++i) {
    const double r_m = static_cast<double>(i) * step_m;
    const double here = correlation.at(r_m * std::cos(angle), r_m * std::sin(angle));
    if (std::isnan(here)) return kNan;
    if (here <= kThreshold) return r_m - step_m * (kThreshold - here) / (before - here);
    before = here;
  }
}

double hann(std::size_t i, std::size_t n) {
  return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
}

// The direction of the waves with the most power, 0 to π.
double strongest_direction_rad(const ArealMap& map) {
  std::vector<Complex> x(map.columns * map.rows);
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      const double z = map.at(row, column);
      x[row * map.columns + column] = std::isnan(z) ? 0.0 : z * hann(row, map.rows) * hann(column, map.columns);
    }
  }
  transform(x, map.columns, map.rows, false);
  const double x_step = 1.0 / (static_cast<double>(map.columns) * map.x_spacing_m);
  const double y_step = 1.0 / (static_cast<double>(map.rows) * map.y_spacing_m);
  const double width = std::numbers::pi / kDirections;
  std::vector<double> power(kDirections, 0.0);
  for (std::size_t row = 0; row <= map.rows / 2; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      const double fx =
          x_step * (column > map.columns / 2 ? static_cast<double>(column) - static_cast<double>(map.columns)
                                             : static_cast<double>(column));
      const double fy = y_step * static_cast<double>(row);
      const double f = std::hypot(fx, fy);
      if (f < 1.5 * std::max(x_step, y_step)) continue;  // what the window makes of the mean
      // A cell of the spectrum is as wide as half a step seen from the origin; half a degree at least.
      const double sigma = std::max(width, 0.5 * std::max(x_step, y_step) / f);
      const double angle = std::atan2(fy, fx);
      const double weight = std::norm(x[row * map.columns + column]) / sigma;
      const int reach = std::min(kDirections / 2, static_cast<int>(std::ceil(3.0 * sigma / width)));
      const int nearest = static_cast<int>(std::lround(angle / width));
      for (int k = nearest - reach; k <= nearest + reach; ++k) {
        const double away = (k * width - angle) / sigma;
        power[static_cast<std::size_t>((k % kDirections + kDirections) % kDirections)] +=
            weight * std::exp(-0.5 * away * away);
      }
    }
  }
  const auto best = std::max_element(power.begin(), power.end()) - power.begin();
  // The vertex of the parabola through the maximum and its neighbours.
  const double here = power[static_cast<std::size_t>(best)];
  const double before = power[static_cast<std::size_t>((best + kDirections - 1) % kDirections)];
  const double after = power[static_cast<std::size_t>((best + 1) % kDirections)];
  const double bend = before - 2.0 * here + after;
  const double shift = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
  return (static_cast<double>(best) + shift) * width;
}

}  // namespace

SurfaceDirection surface_direction(const ArealMap& map) {
  SurfaceDirection out{std::numeric_limits<double>::infinity(), 0.0, kNan};
  const Autocorrelation correlation(map);
  const double step_m = 0.5 * std::min(map.x_spacing_m, map.y_spacing_m);
  for (int i = 0; i < kDirections; ++i) {
    const double r_m = decay_m(correlation, i * std::numbers::pi / kDirections, step_m);
    if (!std::isnan(r_m)) out.shortest_m = std::min(out.shortest_m, r_m);
    out.longest_m = std::isnan(r_m) || std::isnan(out.longest_m) ? kNan : std::max(out.longest_m, r_m);
  }
  if (!std::isfinite(out.shortest_m)) out.shortest_m = kNan;
  const double lay = strongest_direction_rad(map) + 0.5 * std::numbers::pi;
  out.lay_rad = std::fmod(lay, std::numbers::pi);
  return out;
}

}  // namespace asperity
