#include "asperity/profile/blend_acceleration.h"

#include <string>

#include "asperity/base/error.h"

namespace asperity {

std::vector<double> blend_acceleration(std::span<const Eigen::Vector3d> a_world_tip_mps2,
                                       std::span<const Eigen::Vector3d> n_world) {
  if (a_world_tip_mps2.size() != n_world.size()) {
    throw Error("acceleration blending: " + std::to_string(a_world_tip_mps2.size()) + " accelerations but " +
                std::to_string(n_world.size()) + " normals");
  }
  std::vector<double> a_normal_mps2(n_world.size());
  for (std::size_t i = 0; i < n_world.size(); ++i) a_normal_mps2[i] = a_world_tip_mps2[i].dot(n_world[i]);
  return a_normal_mps2;
}

}  // namespace asperity
