#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// The distance along a path up to each of its points: the sum of the straight segments before it (seed
// §5.1). Noise in the points lengthens it (erratum 10): this is the baseline's arc length.
std::vector<double> path_length_m(std::span<const Eigen::Vector3d> p_m);

}  // namespace asperity
