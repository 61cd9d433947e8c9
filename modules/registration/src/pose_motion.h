#pragma once

#include "path_chain.h"

namespace asperity::registration {

// The gradient of a height by the pose: turn about `centre_m`, then shift.
Vector6 pose_gradient(const FacetHeights& heights, std::size_t i, const Eigen::Vector3d& centre_m);

// Turn and shift about `centre_m` that lead from one pose to another.
Vector6 pose_change(const Pose& from, const Pose& to, const Eigen::Vector3d& centre_m);

}  // namespace asperity::registration
