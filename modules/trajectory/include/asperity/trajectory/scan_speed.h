#pragma once

#include <span>

#include <Eigen/Core>

namespace asperity {

// The average scanning velocity from which the thesis takes its process noise (thesis §4.2), m/s: the median
// distance covered in `window_s`, divided by it, over the windows that follow one another in a path
// sampled every `period_s`. The window is long, so that the tracker's noise adds little to it.
double average_scan_speed_mps(std::span<const Eigen::Vector3d> p_m, double period_s, double window_s = 0.5);

}  // namespace asperity
