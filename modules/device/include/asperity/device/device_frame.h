#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/device/haptic_device.h"

namespace asperity {

// The pose of a device in the scene: p_world = scale · R p_device + t. Forces rotate with R and are not scaled.
struct DeviceFrame {
  Eigen::Quaterniond R_world_device = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  double scale = 1.0;  // metres of the scene for a metre of the hand

  Eigen::Vector3d position_m(const Eigen::Vector3d& p_device_m) const {
    return scale * (R_world_device * p_device_m) + translation_m;
  }
  Eigen::Vector3d velocity_mps(const Eigen::Vector3d& v_device_mps) const {
    return scale * (R_world_device * v_device_mps);
  }
  Eigen::Vector3d device_force_N(const Eigen::Vector3d& force_world_N) const {
    return R_world_device.conjugate() * force_world_N;
  }

  template <class V>
  void visit(V& v) {
    v.numbers("R_world_device_xyzw", R_world_device.coeffs().data(), 4, "unit quaternion", {-1.0, 1.0});
    v.numbers("translation_m", translation_m.data(), 3, "position of the device's origin in the scene", {-1e3, 1e3});
    v.field("scale", scale, "metres of the scene for a metre of the hand", {1e-6, 1e6});
  }
};

}  // namespace asperity
