#include "asperity/device/velocity_estimator.h"

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

constexpr std::size_t kWindow = VelocityEstimator::kWindow;

// The place of the position that is `age` readings old.
std::size_t index_of_age(const VelocityEstimator& state, std::size_t age) noexcept {
  return (state.next + kWindow - 1 - age) % kWindow;
}

double fitted_slope(const VelocityEstimator& state, Eigen::Index axis, double noise_m) noexcept {
  const std::size_t newest = index_of_age(state, 0);
  const double p_m = state.p_m[newest][axis];
  const double t_s = state.t_s[newest];
  double slope = 0.0;
  for (std::size_t n = 1; n < state.count; ++n) {
    const std::size_t oldest = index_of_age(state, n);
    const double candidate = (p_m - state.p_m[oldest][axis]) / (t_s - state.t_s[oldest]);
    for (std::size_t between = 1; between < n; ++between) {
      const std::size_t k = index_of_age(state, between);
      const double line_m = p_m - candidate * (t_s - state.t_s[k]);
      if (std::abs(state.p_m[k][axis] - line_m) > noise_m) return slope;
    }
    slope = candidate;
  }
  return slope;
}

}  // namespace

Eigen::Vector3d estimate_velocity(VelocityEstimator& state, const Eigen::Vector3d& p_m, std::uint64_t sequence,
                                  double t_s, double noise_m) noexcept {
  if (!p_m.allFinite()) {
    state = {};
    return state.v_mps;
  }
  if (state.count > 0 && (sequence == state.sequence || !(t_s > state.t_s[index_of_age(state, 0)]))) return state.v_mps;
  state.sequence = sequence;
  state.p_m[state.next] = p_m;
  state.t_s[state.next] = t_s;
  state.next = (state.next + 1) % kWindow;
  state.count = std::min(state.count + 1, kWindow);
  for (Eigen::Index axis = 0; axis < 3; ++axis) state.v_mps[axis] = fitted_slope(state, axis, noise_m);
  return state.v_mps;
}

}  // namespace asperity
