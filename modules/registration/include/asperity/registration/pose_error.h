#pragma once

#include <span>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/registration/registration_result.h"

namespace asperity {

// How far a registered pose is from the true one, and its stated uncertainty.
struct PoseError {
  double rms_m = 0.0;         // of the points' displacement
  double rotation_rad = 0.0;  // angle between the two rotations
  double sigma_m = 0.0;       // the same by the covariance: the root of the expected square
  double sigma_rad = 0.0;
};

// Compares `result` with the true T_mesh_world over points of the path, mesh frame: with E = T T_true⁻¹,
// rms² = mean |E p − p|². By the covariance C of rotation and shift about c, a point moves by P δ with
// P = (−[p − c]×, 1), so sigma² = mean tr(P C Pᵀ). Throws Error for no point.
PoseError pose_error(const RegistrationResult& result, const Pose& true_T_mesh_world,
                     std::span<const Eigen::Vector3d> p_mesh_m);

}  // namespace asperity
