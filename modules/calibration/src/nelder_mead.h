#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace asperity {

// The minimum of `f` near `start` by the downhill simplex (Nelder and Mead, 1965), from a simplex of side `step`
// until its values differ by less than `tolerance`. Values that are not finite count as infinite.
// By hand: of the kept libraries NLopt alone has it, LGPL, with a C callback and no rule for such values (ADR 14).
template <int N, class F>
Eigen::Matrix<double, N, 1> nelder_mead(F f, const Eigen::Matrix<double, N, 1>& start, double step, double tolerance,
                                        int most_evaluations = 400) {
  using Point = Eigen::Matrix<double, N, 1>;
  struct Vertex {
    Point at;
    double value;
  };
  int evaluations = 0;
  const auto evaluate = [&](const Point& at) {
    ++evaluations;
    const double value = f(at);
    return Vertex{at, std::isfinite(value) ? value : std::numeric_limits<double>::infinity()};
  };
  std::array<Vertex, N + 1> simplex;
  simplex[0] = evaluate(start);
  for (int i = 0; i < N; ++i) simplex[static_cast<std::size_t>(i + 1)] = evaluate(start + step * Point::Unit(i));
  const auto by_value = [](const Vertex& a, const Vertex& b) { return a.value < b.value; };
  for (;;) {
    std::sort(simplex.begin(), simplex.end(), by_value);
    if (!(simplex[N].value - simplex[0].value > tolerance) || evaluations >= most_evaluations) return simplex[0].at;
    Point centre = Point::Zero();
    for (int i = 0; i < N; ++i) centre += simplex[static_cast<std::size_t>(i)].at / N;
    const Point reflection = centre - simplex[N].at;
    const Vertex reflected = evaluate(centre + reflection);
    if (reflected.value < simplex[0].value) {
      const Vertex expanded = evaluate(centre + 2.0 * reflection);
      simplex[N] = expanded.value < reflected.value ? expanded : reflected;
    } else if (reflected.value < simplex[N - 1].value) {
      simplex[N] = reflected;
    } else {
      const bool outside = reflected.value < simplex[N].value;
      const Vertex contracted = evaluate(centre + (outside ? 0.5 : -0.5) * reflection);
      if (contracted.value < std::min(reflected.value, simplex[N].value)) {
        simplex[N] = contracted;
      } else {
        for (std::size_t i = 1; i <= N; ++i) simplex[i] = evaluate(0.5 * (simplex[0].at + simplex[i].at));
      }
    }
  }
}

}  // namespace asperity
