#include "even_path.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/signal/zero_phase.h"

namespace asperity {

template <int N>
EvenPath<N> space_evenly(std::span<const double> t_s, std::span<const Eigen::Matrix<double, N, 1>> p_m,
                         double max_rate_hz) {
  using Vector = Eigen::Matrix<double, N, 1>;
  const std::size_t n = t_s.size();
  const double duration_s = t_s[n - 1] - t_s[0];
  const double rate_hz = std::min(max_rate_hz, static_cast<double>(n - 1) / duration_s);
  const auto cells = static_cast<std::size_t>(std::max(2.0, std::floor(duration_s * rate_hz) + 1.0));
  EvenPath<N> path;
  path.start_s = t_s[0];
  path.step_s = duration_s / static_cast<double>(cells - 1);

  std::vector<double> knot_s;
  std::vector<Vector> knot_m;
  knot_s.reserve(cells);
  knot_m.reserve(cells);
  for (std::size_t i = 0; i < n;) {
    const double cell = std::floor((t_s[i] - path.start_s) / path.step_s + 0.5);
    double sum_s = 0.0;
    Vector sum_m = Vector::Zero();
    const std::size_t first = i;
    for (; i < n && std::floor((t_s[i] - path.start_s) / path.step_s + 0.5) == cell; ++i) {
      sum_s += t_s[i];
      sum_m += p_m[i];
    }
    const double count = static_cast<double>(i - first);
    knot_s.push_back(sum_s / count);
    knot_m.push_back(sum_m / count);
  }
  path.p_m.resize(cells);
  std::size_t k = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    const double t = path.time_s(c);
    while (k + 2 < knot_s.size() && knot_s[k + 1] < t) ++k;
    if (knot_s.size() == 1) {
      path.p_m[c] = knot_m[0];
      continue;
    }
    // The outermost cells reach half a cell past their knots: extrapolated, as the path goes on.
    const double x = (t - knot_s[k]) / (knot_s[k + 1] - knot_s[k]);
    path.p_m[c] = knot_m[k] + std::clamp(x, -1.0, 2.0) * (knot_m[k + 1] - knot_m[k]);
  }
  return path;
}

template <int N>
EvenPath<N> low_pass(const EvenPath<N>& path, double cutoff_hz) {
  const double rate_hz = 1.0 / path.step_s;
  EvenPath<N> out = path;
  // The pass's own corner lies a quarter above the cut-off and must stay below half the rate.
  if (cutoff_hz * 1.3 >= 0.5 * rate_hz) return out;
  std::vector<double> x(path.size());
  for (int axis = 0; axis < N; ++axis) {
    for (std::size_t i = 0; i < path.size(); ++i) x[i] = path.p_m[i][axis];
    const std::vector<double> y = zero_phase_lowpass(x, cutoff_hz, rate_hz);
    for (std::size_t i = 0; i < path.size(); ++i) out.p_m[i][axis] = y[i];
  }
  return out;
}

template EvenPath<2> space_evenly<2>(std::span<const double>, std::span<const Eigen::Vector2d>, double);
template EvenPath<3> space_evenly<3>(std::span<const double>, std::span<const Eigen::Vector3d>, double);
template EvenPath<2> low_pass<2>(const EvenPath<2>&, double);
template EvenPath<3> low_pass<3>(const EvenPath<3>&, double);

}  // namespace asperity
