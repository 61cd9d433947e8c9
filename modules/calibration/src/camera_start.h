#pragma once

#include <span>

#include "asperity/calibration/calibration_board.h"
#include "camera_bundle.h"

namespace asperity {

// Start values for refine_bundle: Zhang's closed form for the focal length (OpenCV), no distortion, the principal point
// in the image's centre, and each view's pose by IPPE.
CameraBundle start_bundle(std::span<const BoardView* const> views, int width, int height);

// Replaces the pose of every view whose mirrored solution (a flat board has two that look alike) fits better;
// true if there was one.
bool unmirror_poses(std::span<const BoardView* const> views, CameraBundle& bundle);

}  // namespace asperity
