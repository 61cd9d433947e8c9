#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// The tip's acceleration along the outward surface normal, signed, m/s²: a·n for each sample (seed §4.3,
// erratum 3; the seed's weights per accelerometer axis are this scalar product in the sensor's frame).
// Throws Error if the sizes differ.
std::vector<double> blend_acceleration(std::span<const Eigen::Vector3d> a_world_tip_mps2,
                                       std::span<const Eigen::Vector3d> n_world);

}  // namespace asperity
