#pragma once

#include <optional>

#include "asperity/geometry/pose.h"
#include "asperity/recording/recording.h"

namespace asperity {

// The T_mesh_world that a recording simulated over a mesh knows: seven numbers [x, y, z, qw, qx, qy, qz] under
// `extra` in its recording.json. nullopt if it has none; Error if they are no pose.
std::optional<Pose> true_pose(const Recording& recording);

}  // namespace asperity
