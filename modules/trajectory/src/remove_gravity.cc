#include "asperity/trajectory/remove_gravity.h"

#include <string>

#include "asperity/base/error.h"

namespace asperity {

std::vector<Eigen::Vector3d> remove_gravity(std::span<const Eigen::Vector3d> accel_counts,
                                            std::span<const Eigen::Quaterniond> q_world_marker,
                                            const AccelerometerCalibration& calibration,
                                            const Eigen::Vector3d& gravity_world_mps2) {
  if (accel_counts.size() != q_world_marker.size()) {
    throw Error("gravity removal: " + std::to_string(accel_counts.size()) + " accelerations but " +
                std::to_string(q_world_marker.size()) + " orientations");
  }
  std::vector<Eigen::Vector3d> a_world_mps2;
  a_world_mps2.reserve(accel_counts.size());
  for (std::size_t i = 0; i < accel_counts.size(); ++i) {
    a_world_mps2.push_back(q_world_marker[i] * calibration.specific_force_mps2(accel_counts[i]) + gravity_world_mps2);
  }
  return a_world_mps2;
}

}  // namespace asperity
