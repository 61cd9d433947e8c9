#pragma once

#include "asperity/registration/refine_registration.h"
#include "path_chain.h"

namespace asperity::registration {

// The gradient of a height by the pose: turn about `centre_m`, then shift.
Vector6 pose_gradient(const FacetHeights& heights, std::size_t i, const Eigen::Vector3d& centre_m);

// Covariance of the plain least squares that gave the start, when the points have slow errors: H⁻¹ JᵀCJ H⁻¹.
Matrix6 start_covariance(const PathChain& chain, const FacetHeights& heights, const Pose& T_mesh_world,
                         const Eigen::Vector3d& centre_m, const RefineConfig& config);

}  // namespace asperity::registration
