#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace asperity {

// The haptic texture of one triangle: the `h` line of an augmented Wavefront file (thesis §6.3, erratum 22).
struct HapticTriangle {
  std::int32_t texture = -1;           // index of the texture in the scene; -1: none
  std::array<Eigen::Vector2d, 3> xy_mm{// for each corner: along the scan path, and signed across it
                                       Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
};

}  // namespace asperity
