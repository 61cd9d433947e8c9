#pragma once

#include <Eigen/Core>

namespace asperity {

// The input of a servo step from the hand, in the scene's world.
struct DeviceState {
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();    // of the device point, the tip's centre
  Eigen::Vector3d v_world_mps = Eigen::Vector3d::Zero();  // of the device point
  double dt_s = 1e-3;                                     // since the step before
};

}  // namespace asperity
