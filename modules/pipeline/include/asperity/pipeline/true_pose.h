#pragma once

#include <optional>

#include "asperity/geometry/pose.h"
#include "asperity/recording/recording.h"

namespace asperity {

// The T_mesh_world that a recording simulated over a mesh knows, its rotation of unit length to the last digit.
// nullopt if it has none.
std::optional<Pose> true_pose(const Recording& recording);

}  // namespace asperity
