#include "limit_force.h"

#include <algorithm>

namespace asperity {

Eigen::Vector3d limit_force(const Eigen::Vector3d& force_N, double max_force_N) noexcept {
  if (!force_N.allFinite()) return Eigen::Vector3d::Zero();
  const double length_N = force_N.stableNorm();
  if (length_N <= max_force_N) return force_N;
  return force_N * (max_force_N / length_N);
}

Eigen::Vector3d limit_force_rate(const Eigen::Vector3d& last_N, const Eigen::Vector3d& force_N, double max_rate_N_per_s,
                                 double dt_s) noexcept {
  const Eigen::Vector3d change_N = force_N - last_N;
  const double allowed_N = max_rate_N_per_s * dt_s;
  const double length_N = change_N.stableNorm();
  if (length_N <= allowed_N) return force_N;
  return last_N + change_N * (allowed_N / length_N);
}

double next_gain(double gain, bool well, const SafetyConfig& config, double dt_s) noexcept {
  if (well) return config.soft_start_s > 0.0 ? std::min(gain + dt_s / config.soft_start_s, 1.0) : 1.0;
  return config.ramp_down_s > 0.0 ? std::max(gain - dt_s / config.ramp_down_s, 0.0) : 0.0;
}

}  // namespace asperity
