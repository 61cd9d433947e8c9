#include "square_poses.h"

#include <opencv2/calib3d.hpp>

#include "asperity/recording/camera_model.h"

namespace asperity {

std::vector<Pose> square_poses(const CameraCalibration& camera, const MarkerPlacement& marker,
                               const Eigen::Matrix<double, 2, 4>& corners_px) {
  // OpenCV's order for this method begins at (−, +) with y up, so it is that of our corners; its frame is turned about
  // x.
  const double half_m = 0.5 * marker.size_m;
  const std::vector<cv::Point3d> square{
      {-half_m, half_m, 0.0}, {half_m, half_m, 0.0}, {half_m, -half_m, 0.0}, {-half_m, -half_m, 0.0}};
  std::vector<cv::Point2d> rays;
  for (int i = 0; i < 4; ++i) {
    const auto ray = unproject(camera, corners_px.col(i));
    if (!ray) return {};
    rays.emplace_back(ray->x(), ray->y());
  }
  std::vector<cv::Mat> rotations, translations;
  try {
    cv::solvePnPGeneric(square, rays, cv::Matx33d::eye(), cv::noArray(), rotations, translations, false,
                        cv::SOLVEPNP_IPPE_SQUARE);
  } catch (const cv::Exception&) {
    return {};
  }
  const Pose T_up_tag{Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), Eigen::Vector3d::Zero()};
  const Pose T_tag_marker = marker.T_marker_tag.inverse();
  std::vector<Pose> out;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const Eigen::Vector3d turn(rotations[i].at<double>(0), rotations[i].at<double>(1), rotations[i].at<double>(2));
    const Eigen::Vector3d shift(translations[i].at<double>(0), translations[i].at<double>(1),
                                translations[i].at<double>(2));
    if (!turn.allFinite() || !shift.allFinite() || !(shift.z() > 0.0)) continue;
    out.push_back(Pose{exp_rotation(turn), shift} * T_up_tag * T_tag_marker);
  }
  return out;
}

}  // namespace asperity
