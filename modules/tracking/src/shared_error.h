#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "pose_error.h"

namespace asperity {

// What a tag's corners are off by, px, for a standard deviation of each of the errors that all frames share; a column
// an error, independent of the others.
using SharedColumns = Eigen::Matrix<double, 8, Eigen::Dynamic>;

// The camera's covariance, of fx, fy, cx, cy, k1, k2, p1, p2, k3; where it has none, what config assumes of one:
// fx and fy wrong alike by focal_error and against each other by a third of it, the centre by focal_error · fx in each
// direction, k1 by distortion_error, p1 and p2 by a twentieth of it.
Eigen::Matrix<double, 9, 9> camera_covariance(const CameraCalibration& camera, const BodyPoseConfig& config);

// Of each tag seen: the camera's nine parameters (by a root of their covariance), the scale of the print, and of each
// plane of tags the three ways in which it can sag.
std::vector<SharedColumns> shared_columns(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                                          const Pose& pose, std::span<const CornersAtPose> corners,
                                          std::span<const std::size_t> tag_of, const BodyPoseConfig& config);

}  // namespace asperity
