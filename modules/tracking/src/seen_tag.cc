#include "asperity/tracking/seen_tag.h"

namespace asperity {

Eigen::Matrix<double, 3, 4> tag_corners_m(const MarkerPlacement& marker) {
  const double half_m = 0.5 * marker.size_m;
  Eigen::Matrix<double, 3, 4> out;
  out.col(0) = marker.T_marker_tag * Eigen::Vector3d(-half_m, -half_m, 0.0);
  out.col(1) = marker.T_marker_tag * Eigen::Vector3d(half_m, -half_m, 0.0);
  out.col(2) = marker.T_marker_tag * Eigen::Vector3d(half_m, half_m, 0.0);
  out.col(3) = marker.T_marker_tag * Eigen::Vector3d(-half_m, half_m, 0.0);
  return out;
}

}  // namespace asperity
