#pragma once

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

Json json_of_point(const Eigen::Vector3d& p);

// [x, y, z, qw, qx, qy, qz]: metres, and a unit quaternion with qw >= 0.
Json json_of_pose(const Pose& pose);

// The same back. Throws Error naming `what` for anything but three finite numbers, or seven of which the last four are
// a quaternion that is unit to 1e-6; it is normalised, and its qw is not negative.
Eigen::Vector3d point_of_json(const Json& json, std::string_view what);
Pose pose_of_json(const Json& json, std::string_view what);

}  // namespace asperity::studio
