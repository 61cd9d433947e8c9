#pragma once

#include <cstdint>
#include <vector>

#include "asperity/geometry/pose.h"
#include "asperity/simulation/render_board.h"
#include "asperity/simulation/simulated_camera_config.h"

namespace asperity {

// How a careful person shows a board to a camera: T_world_board, tilted by 10 to 40 degrees in directions all around,
// near and far, over all of the image, its pattern always whole in it. Deterministic from `seed`. Throws Error for a
// board that the camera cannot see whole in such poses.
std::vector<Pose> board_poses(const SimulatedCameraConfig& config, const SimulatedBoard& board, int count,
                              std::uint64_t seed);

}  // namespace asperity
