#pragma once

#include "asperity/device/safety_config.h"

namespace asperity {

// The factor of the force at this tick, within 0 and 1, from that of the tick before: it grows by dt_s / soft_start_s
// if all is well, and falls by dt_s / ramp_down_s if not. Realtime-safe: yes.
double next_gain(double gain, bool well, const SafetyConfig& config, double dt_s) noexcept;

}  // namespace asperity
