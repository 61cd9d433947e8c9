#pragma once

#include "asperity/import/file_streams.h"

namespace asperity {

// The white noise of one pose, standard deviation an axis.
struct PoseNoise {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();    // along the world's axes
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  // about the world's axes
};

// By fourth differences (signal/white_noise.h). What a tracker smooths away and what it has wrong for longer than a few
// poses is not in it; where poses are so few that the motion bends between them, the motion is. Zero where there are
// too few poses.
PoseNoise estimate_pose_noise(const PoseStream& pose);

}  // namespace asperity
