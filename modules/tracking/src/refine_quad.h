#pragma once

#include <Eigen/Core>

#include "asperity/image/gray_image.h"

namespace asperity {

// Moves the corners of a dark quadrilateral on light ground to where the lines of its sides meet. On each side the edge
// is sought along its normal, within `cell_px` (the width of the dark border) on either side, at the mean place of the
// brightness's rise weighted by its square; a line is fitted through these places by total least squares. Corners go
// clockwise in the image, px, the centre of the first pixel at (0, 0). They remain as they are, and the answer is
// false, where a side shows no edge, leaves the image, or a corner would move by more than a border's width.
bool refine_quad(const GrayImage& image, double cell_px, Eigen::Matrix<double, 2, 4>& corners_px);

}  // namespace asperity
