#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// For each sample whether the tip moves: its speed along the surface (without the part along the normal)
// is at least `min_speed_mps`. Samples that do not are those of stick and slip and of rest, which the seed
// drops (seed §4.4), here after the integration, which needs them (erratum 25). Throws Error if the sizes
// differ.
std::vector<char> mark_stick_slip(std::span<const Eigen::Vector3d> v_world_tip_mps,
                                  std::span<const Eigen::Vector3d> n_world, double min_speed_mps);

}  // namespace asperity
