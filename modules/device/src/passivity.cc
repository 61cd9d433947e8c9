#include "asperity/device/passivity.h"

#include <algorithm>
#include <cmath>

namespace asperity {

Eigen::Vector3d dissipate_created_energy(const SafetyConfig& config, PassivityState& state,
                                         const PassivityInput& input) noexcept {
  if (state.started) {
    const Eigen::Vector3d way_m = input.hand_m - state.hand_m;
    const double given_J = -state.force_N.dot(way_m);
    const double damped_J = config.assumed_damping_N_s_per_m * way_m.squaredNorm() / input.dt_s;
    state.excess_J += given_J + damped_J - (input.stored_J - state.stored_J);
  }
  state.started = true;
  state.hand_m = input.hand_m;
  state.stored_J = input.stored_J;
  // Finite numbers may still overflow, and one that is none would stay for ever.
  if (std::isnan(state.excess_J)) state.excess_J = 0.0;
  if (!std::isfinite(state.stored_J)) state.stored_J = 0.0;
  state.excess_J = std::clamp(state.excess_J, -config.max_debt_J, config.max_credit_J);
  if (input.forgive) state.excess_J = std::max(state.excess_J, 0.0);
  if (state.excess_J >= 0.0) return Eigen::Vector3d::Zero();
  state.excess_J *= std::exp(-input.dt_s / config.debt_leak_s);
  const double v2 = input.hand_mps.squaredNorm();
  if (!input.touching || !(v2 > 0.0)) return Eigen::Vector3d::Zero();
  const double damping = std::min(-state.excess_J / (input.dt_s * v2), config.max_damping_N_s_per_m);
  return -damping * input.hand_mps;
}

double spring_energy_J(const Eigen::Vector3d& force_N, const Eigen::Vector3d& stretch_m, double max_force_N) noexcept {
  const double stretch = stretch_m.norm();
  if (!(stretch > 0.0)) return 0.0;
  const double pull_N = std::max(force_N.dot(stretch_m) / stretch, 0.0);
  if (pull_N <= max_force_N) return 0.5 * pull_N * stretch;
  return max_force_N * stretch * (1.0 - 0.5 * max_force_N / pull_N);
}

}  // namespace asperity
