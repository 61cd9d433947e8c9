#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// Where a hand wants to be at one instant, in the device's axes, and how hard it presses there.
struct HandPoint {
  std::int64_t t_ns = 0;
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
  double press_N = 0.0;  // along the hand's press direction
};

// Times rise strictly; place and force are linear between the points.
using HandPath = std::vector<HandPoint>;

}  // namespace asperity
