#include "asperity/profile/mark_stick_slip.h"

#include <string>

#include "asperity/base/error.h"

namespace asperity {

std::vector<char> mark_stick_slip(std::span<const Eigen::Vector3d> v_world_tip_mps,
                                  std::span<const Eigen::Vector3d> n_world, double min_speed_mps) {
  if (v_world_tip_mps.size() != n_world.size()) {
    throw Error("stick and slip: " + std::to_string(v_world_tip_mps.size()) + " velocities but " +
                std::to_string(n_world.size()) + " normals");
  }
  std::vector<char> moving(n_world.size());
  for (std::size_t i = 0; i < n_world.size(); ++i) {
    const Eigen::Vector3d along_mps = v_world_tip_mps[i] - v_world_tip_mps[i].dot(n_world[i]) * n_world[i];
    moving[i] = along_mps.norm() >= min_speed_mps ? 1 : 0;
  }
  return moving;
}

}  // namespace asperity
