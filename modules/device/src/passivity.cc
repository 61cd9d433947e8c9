#include "asperity/device/passivity.h"

#include <algorithm>
#include <cmath>

namespace asperity {

Eigen::Vector3d damp_created_energy(const SafetyConfig& config, PassivityState& state,
                                    const PassivityInput& input) noexcept {
  if (state.started) state.energy_J -= state.force_N.dot(input.hand_m - state.hand_m);
  state.started = true;
  state.hand_m = input.hand_m;
  state.energy_J = std::clamp(state.energy_J, -config.max_debt_J, config.max_credit_J);
  // Without contact nothing is stored: what is left of the credit was dissipated and is not owed to the hand.
  if (!input.touching) state.energy_J = std::min(state.energy_J, 0.0);
  if (input.forgive) state.energy_J = std::max(state.energy_J, 0.0);
  if (state.energy_J >= 0.0) return Eigen::Vector3d::Zero();
  state.energy_J *= std::exp(-input.dt_s / config.debt_leak_s);
  const double v2 = input.hand_mps.squaredNorm();
  if (!input.touching || !(v2 > 0.0)) return Eigen::Vector3d::Zero();
  const double damping = std::min(-state.energy_J / (input.dt_s * v2), config.max_damping_N_s_per_m);
  return -damping * input.hand_mps;
}

}  // namespace asperity
