#pragma once

#include "asperity/recording/calibration.h"

namespace asperity {

// A calibration that stands for none: nominal scales (0: unknown, taken as 1), no offsets, the sensor's rotation to the
// marker unknown, the tip at the marker's origin. `uncalibrated` states this.
Calibration make_uncalibrated(double accel_counts_per_mps2, double gyro_counts_per_radps, double newton_per_count);

}  // namespace asperity
