#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/recording/calibration.h"

namespace asperity {

// A tag of a body as an image shows it.
struct SeenTag {
  std::size_t tag = 0;  // its place in the body's list of markers
  Eigen::Matrix<double, 2, 4> corners_px;
  // Of the corners' errors (x and y of the first corner, x and y of the second, …), px²; with `has_covariance` only.
  Eigen::Matrix<double, 8, 8> covariance_px2;
  bool has_covariance = false;
};

// The corners of a tag's black border in the marker frame, m, in a detection's order.
Eigen::Matrix<double, 3, 4> tag_corners_m(const MarkerPlacement& marker);

}  // namespace asperity
