#pragma once

#include <vector>

#include "asperity/geometry/pose.h"
#include "asperity/tracking/seen_tag.h"

namespace asperity {

// The poses T_camera_marker, at most two, that one tag's four corners allow (Collins and Bartoli, 2014, by OpenCV).
// None where the corners are no picture of a square.
std::vector<Pose> square_poses(const CameraCalibration& camera, const MarkerPlacement& marker,
                               const Eigen::Matrix<double, 2, 4>& corners_px);

}  // namespace asperity
