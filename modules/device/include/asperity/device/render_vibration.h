#pragma once

#include <span>
#include <vector>

#include "asperity/device/vibration_config.h"

namespace asperity {

// The sound of forces at `servo_rate_Hz`, for a file: round(n · audio_rate / servo_rate) samples in ±ceiling, the
// first at the time of the first force, the last faded out. The same steps as an audio sink's (docs/vibrotactile.md)
// without its latency and clock correction. Throws Error for a config out of range or a force that is not finite.
std::vector<double> render_vibration(std::span<const double> force_N, const VibrationConfig& config);

}  // namespace asperity
