#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/tracking/solve_body_pose.h"

namespace asperity {

// A tag's corners at the pose that was found: x and y of the first corner, x and y of the second, ….
struct CornersAtPose {
  Eigen::Matrix<double, 3, 4> p_marker_m;
  Eigen::Matrix<double, 8, 8> covariance_px2;  // of the corners' own noise
  Eigen::Matrix<double, 8, 1> residual_px;     // predicted minus seen
  Eigen::Matrix<double, 8, 6> by_pose;         // of the predicted corners by (translation; rotation vector)
  Eigen::Matrix<double, 6, 8> weighed;         // Jᵀ W of the least squares: 0 for corners left out
  std::array<bool, 4> used{};
};

struct PoseError {
  Eigen::Matrix<double, 6, 6> noise;   // what is of this frame alone
  Eigen::Matrix<double, 6, 6> shared;  // what all frames of this camera and body have alike
  double corner_px = 0.0;  // RMS of what each corner is off by, beside its own noise, as the residual shows it
  double smooth_px = 0.0;  // RMS of what moves neighbouring corners alike, a mode of the lowest degree
};

// The covariance of a least-squares pose P r, P = (Σ JᵀWJ)⁻¹ JᵀW, from what its corners' errors are made of
// (docs/tracking.md):
//   e = e_noise + a e_corner + c Φ β + (∂/∂camera) δ_camera + (∂/∂body) δ_body,
// e_noise of the corners' covariances, e_corner independent of unit variance, Φ the Legendre polynomials up to the
// third degree over the body's view, β independent with standard deviations 1, 0.4, 0.16, 0.064 by degree: lens,
// rolling shutter, a board that is bent. The sizes a and c are the frame's own: their posterior means over a grid by
// the restricted likelihood of the residuals, each with a half-t prior (4 degrees of freedom, config.unmodelled_px).
// `normal` is Σ JᵀWJ. The last two terms are `shared`; they are the camera's covariance, or what config assumes where
// the camera has none, and the body's print scale, placement and bend.
PoseError find_pose_error(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body, const Pose& pose,
                          std::span<const CornersAtPose> corners, std::span<const std::size_t> tag_of,
                          const Eigen::Matrix<double, 6, 6>& normal, const BodyPoseConfig& config);

}  // namespace asperity
