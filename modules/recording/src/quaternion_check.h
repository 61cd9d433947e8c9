#pragma once

#include <Eigen/Geometry>

namespace asperity {

enum class QuaternionState { kUnit, kRepaired, kUnusable };

// Makes `q` unit. Up to 1e-6 off is the rounding of a text file, up to 1e-3 a sloppy writer
// (kRepaired); beyond that the four numbers are no rotation, and `q` is left alone. A quaternion that
// is unit to the last digit is not touched, so that writing and reading change nothing.
QuaternionState make_unit(Eigen::Quaterniond& q);

}  // namespace asperity
