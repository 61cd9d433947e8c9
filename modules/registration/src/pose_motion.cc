#include "pose_motion.h"

#include <Eigen/Geometry>

namespace asperity::registration {

Vector6 pose_gradient(const FacetHeights& heights, std::size_t i, const Eigen::Vector3d& centre_m) {
  Vector6 row;
  row << (heights.p_mesh_m[i] - centre_m).cross(heights.normal[i]), heights.normal[i];
  return row;
}

Vector6 pose_change(const Pose& from, const Pose& to, const Eigen::Vector3d& centre_m) {
  const Eigen::Quaterniond turn = to.rotation * from.rotation.conjugate();
  Vector6 out;
  out << log_rotation(turn), to.translation_m - centre_m - turn * (from.translation_m - centre_m);
  return out;
}

}  // namespace asperity::registration
