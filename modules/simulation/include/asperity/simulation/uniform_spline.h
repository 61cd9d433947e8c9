#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// A uniform cubic B-spline, twice continuously differentiable, with `nodes` as control points `spacing` apart
// from `first`. Beyond the ends it continues straight. At least two nodes.
template <int N>
class UniformSpline {
 public:
  using Value = Eigen::Matrix<double, N, 1>;

  UniformSpline() = default;
  UniformSpline(std::vector<Value> nodes, double first, double spacing)
      : nodes_(std::move(nodes)), first_(first), spacing_(spacing) {}

  Value value(double x) const {
    const double last = static_cast<double>(nodes_.size() - 1), place = (x - first_) / spacing_;
    const double inside = std::clamp(place, 0.0, last);
    const auto [i, u] = split(inside);
    const double w = 1.0 - u;
    const Value out = (w * w * w * node(i - 1) + (4.0 - 6.0 * u * u + 3.0 * u * u * u) * node(i) +
                       (4.0 - 6.0 * w * w + 3.0 * w * w * w) * node(i + 1) + u * u * u * node(i + 2)) /
                      6.0;
    return place == inside ? out : Value(out + (place - inside) * spacing_ * derivative(x));
  }

  Value derivative(double x) const {
    const auto [i, u] = split(std::clamp((x - first_) / spacing_, 0.0, static_cast<double>(nodes_.size() - 1)));
    const double w = 1.0 - u;
    return (-w * w * node(i - 1) + (3.0 * u * u - 4.0 * u) * node(i) + (4.0 * w - 3.0 * w * w) * node(i + 1) +
            u * u * node(i + 2)) /
           (2.0 * spacing_);
  }

 private:
  std::pair<std::ptrdiff_t, double> split(double place) const {
    const auto i = std::min(static_cast<std::ptrdiff_t>(place), static_cast<std::ptrdiff_t>(nodes_.size()) - 2);
    return {i, place - static_cast<double>(i)};
  }
  // Mirrored through the ends, so that the spline passes through its first and last node.
  Value node(std::ptrdiff_t i) const {
    const auto last = static_cast<std::ptrdiff_t>(nodes_.size()) - 1;
    if (i < 0) return 2.0 * nodes_.front() - nodes_[static_cast<std::size_t>(std::min(-i, last))];
    if (i > last)
      return 2.0 * nodes_.back() - nodes_[static_cast<std::size_t>(std::max<std::ptrdiff_t>(2 * last - i, 0))];
    return nodes_[static_cast<std::size_t>(i)];
  }

  std::vector<Value> nodes_;
  double first_ = 0.0, spacing_ = 1.0;
};

}  // namespace asperity
