#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"

namespace asperity {

// A rigid motion that shifts `centre_m` by `shift_m` and turns about it by `turn_rad`, both in random directions: what
// a guess that far off is off by. The same seed gives the same motion.
Pose random_motion(double shift_m, double turn_rad, const Eigen::Vector3d& centre_m, std::uint64_t seed);

}  // namespace asperity
