#pragma once

#include "asperity/device/servo_statistics.h"

namespace asperity {

// The simulated hand strokes a plate under a texture of 128 harmonics, by the clock: how well the servo loop keeps its
// schedule meanwhile.
ServoStatistics stroke_plate(double seconds, double rate_Hz, double spin_s);

}  // namespace asperity
