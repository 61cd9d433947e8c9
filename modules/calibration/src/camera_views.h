#pragma once

#include <span>

#include "asperity/calibration/calibrate_camera.h"

namespace asperity {

// Throws Error unless there are enough views with enough corners, finite and inside an image of this size.
void check_views(std::span<const BoardView> views, int width, int height, const CameraFitConfig& config);

// Share of the image's area within the convex hull of all corners of all views.
double image_coverage(std::span<const BoardView* const> views, int width, int height);

// Throws Error if `coverage` is less than the configured.
void refuse_narrow_coverage(double coverage, const CameraFitConfig& config);

}  // namespace asperity
