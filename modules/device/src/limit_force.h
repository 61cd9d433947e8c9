#pragma once

#include <Eigen/Core>

#include "asperity/device/safety_config.h"

namespace asperity {

// `force_N` if it is no longer than `max_force_N`, else shortened to that in the same direction. A force that is not
// finite becomes zero. Realtime-safe: yes.
Eigen::Vector3d limit_force(const Eigen::Vector3d& force_N, double max_force_N) noexcept;

// The point of the segment from `last_N` to `force_N` that is nearest to `force_N` and at most
// `max_rate_N_per_s · dt_s` from `last_N`. Between two forces within a limit it stays within that limit.
// Realtime-safe: yes.
Eigen::Vector3d limit_force_rate(const Eigen::Vector3d& last_N, const Eigen::Vector3d& force_N, double max_rate_N_per_s,
                                 double dt_s) noexcept;

// The factor of the force at this tick, within 0 and 1, from that of the tick before: it grows by dt_s / soft_start_s
// if all is well, and falls by dt_s / ramp_down_s if not. Realtime-safe: yes.
double next_gain(double gain, bool well, const SafetyConfig& config, double dt_s) noexcept;

}  // namespace asperity
