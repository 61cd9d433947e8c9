#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"

namespace asperity {

// The proxy between two steps: where the tip's centre would be if objects were rigid.
struct ProxyState {
  bool started = false;
  bool starts_inside = false;  // the device was inside an object and has not left it yet: no force
  bool sticking = false;
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d device_world_m = Eigen::Vector3d::Zero();  // of the step before
};

}  // namespace asperity
