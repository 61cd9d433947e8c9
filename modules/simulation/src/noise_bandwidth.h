#pragma once

#include <numbers>

namespace asperity {

// The bandwidth of the ideal low-pass that lets as much white noise through as a sensor's own: π/2 of the
// cut-off for one pole, π/(2√2) for a second-order Butterworth; half the rate without a filter.
inline double noise_bandwidth_Hz(double cutoff_Hz, int poles, double rate_Hz) {
  if (cutoff_Hz <= 0.0) return 0.5 * rate_Hz;
  return cutoff_Hz * 0.5 * std::numbers::pi / (poles == 1 ? 1.0 : std::numbers::sqrt2);
}

}  // namespace asperity
