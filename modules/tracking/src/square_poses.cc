#include "square_poses.h"

#include <array>
#include <cstddef>

#include "asperity/recording/camera_model.h"
#include "asperity/vision/vision.h"

namespace asperity {

std::vector<Pose> square_poses(const CameraCalibration& camera, const MarkerPlacement& marker,
                               const Eigen::Matrix<double, 2, 4>& corners_px) {
  // OpenCV's order for this method begins at (−, +) with y up, so it is that of our corners; its frame is turned about
  // x.
  std::array<Eigen::Vector2d, 4> rays;
  for (int i = 0; i < 4; ++i) {
    const auto ray = unproject(camera, corners_px.col(i));
    if (!ray) return {};
    rays[static_cast<std::size_t>(i)] = {ray->x(), ray->y()};
  }
  std::vector<PlanePose> poses;
  try {
    poses = vision().square_poses(0.5 * marker.size_m, rays);
  } catch (const VisionError&) {
    return {};
  }
  const Pose T_up_tag{Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), Eigen::Vector3d::Zero()};
  const Pose T_tag_marker = marker.T_marker_tag.inverse();
  std::vector<Pose> out;
  for (const auto& [turn, shift] : poses) {
    if (!turn.allFinite() || !shift.allFinite() || !(shift.z() > 0.0)) continue;
    out.push_back(Pose{exp_rotation(turn), shift} * T_up_tag * T_tag_marker);
  }
  return out;
}

}  // namespace asperity
