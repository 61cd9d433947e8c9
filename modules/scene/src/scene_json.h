#pragma once

#include "asperity/geometry/pose.h"
#include "asperity/json/json_object.h"

namespace asperity {

// [x, y, z, qw, qx, qy, qz]. Throws Error for a quaternion off unit length by more than rounding.
Pose parse_pose(const JsonItem& item);
Json format_pose(const Pose& pose);

}  // namespace asperity
