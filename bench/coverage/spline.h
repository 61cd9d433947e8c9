#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace bench {

// The natural cubic spline through points of strictly rising x; nan outside them and in holes wider than `max_hole`.
class Spline {
 public:
  Spline(std::vector<double> x, std::vector<double> y, double max_hole)
      : x_(std::move(x)), y_(std::move(y)), bend_(x_.size(), 0.0), max_hole_(max_hole) {
    const std::size_t n = x_.size();
    if (n < 3) return;
    std::vector<double> over(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double before = x_[i] - x_[i - 1], after = x_[i + 1] - x_[i];
      const double slopes = (y_[i + 1] - y_[i]) / after - (y_[i] - y_[i - 1]) / before;
      const double pivot = 2.0 * (before + after) - before * over[i - 1];
      over[i] = after / pivot;
      bend_[i] = (6.0 * slopes - before * bend_[i - 1]) / pivot;
    }
    for (std::size_t i = n - 2; i > 0; --i) bend_[i] -= over[i] * bend_[i + 1];
  }

  double at(double x) const {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    if (x_.size() < 2 || !(x >= x_.front() && x <= x_.back())) return kNan;
    const auto above = std::upper_bound(x_.begin(), x_.end(), x);
    const auto b = std::clamp<std::size_t>(static_cast<std::size_t>(above - x_.begin()), 1, x_.size() - 1);
    const std::size_t a = b - 1;
    const double h = x_[b] - x_[a];
    if (h > max_hole_) return kNan;
    const double q = (x - x_[a]) / h, p = 1.0 - q;
    return p * y_[a] + q * y_[b] + ((p * p * p - p) * bend_[a] + (q * q * q - q) * bend_[b]) * h * h / 6.0;
  }

 private:
  std::vector<double> x_, y_, bend_;
  double max_hole_;
};

}  // namespace bench
