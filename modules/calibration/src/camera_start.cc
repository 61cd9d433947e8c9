#include "camera_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

struct CvView {
  std::vector<cv::Point3f> board;
  std::vector<cv::Point2f> pixel;
};

CvView to_cv(const BoardView& view) {
  CvView out;
  for (std::size_t i = 0; i < view.corner_px.size(); ++i) {
    const Eigen::Vector3f p = view.p_board_m[i].cast<float>();
    const Eigen::Vector2f u = view.corner_px[i].cast<float>();
    out.board.emplace_back(p.x(), p.y(), p.z());
    out.pixel.emplace_back(u.x(), u.y());
  }
  return out;
}

Pose to_pose(const cv::Mat& rotation, const cv::Mat& translation) {
  const auto vector = [](const cv::Mat& m) {
    return Eigen::Vector3d(m.at<double>(0), m.at<double>(1), m.at<double>(2));
  };
  return {exp_rotation(vector(rotation)), vector(translation)};
}

// Both poses in which the flat board looks nearly as it was seen, the better first.
std::vector<Pose> planar_poses(const CvView& view, const CameraVector& c) {
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << c[0], 0.0, c[2], 0.0, c[1], c[3], 0.0, 0.0, 1.0);
  const cv::Mat distortion = (cv::Mat_<double>(5, 1) << c[4], c[5], c[6], c[7], c[8]);
  std::vector<cv::Mat> rotations, translations;
  cv::solvePnPGeneric(view.board, view.pixel, matrix, distortion, rotations, translations, false, cv::SOLVEPNP_IPPE);
  std::vector<Pose> out;
  for (std::size_t i = 0; i < rotations.size(); ++i) out.push_back(to_pose(rotations[i], translations[i]));
  return out;
}

double start_focal_px(const std::vector<CvView>& views, int width, int height) {
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> pixel;
  for (const CvView& view : views) {
    board.push_back(view.board);
    pixel.push_back(view.pixel);
  }
  const double f = cv::initCameraMatrix2D(board, pixel, {width, height}).at<double>(0, 0);
  const double side = std::max(width, height);
  // From 157 to 3 degrees across; beyond, the closed form was lost in noise.
  return f > 0.1 * side && f < 20.0 * side ? f : side;
}

}  // namespace

CameraBundle start_bundle(std::span<const BoardView* const> views, int width, int height) {
  try {
    std::vector<CvView> cv_views;
    for (const BoardView* view : views) cv_views.push_back(to_cv(*view));
    const double f = start_focal_px(cv_views, width, height);
    CameraBundle bundle;
    bundle.parameters.head<4>() << f, f, 0.5 * (width - 1), 0.5 * (height - 1);
    for (std::size_t v = 0; v < views.size(); ++v) {
      const std::vector<Pose> poses = planar_poses(cv_views[v], bundle.parameters);
      if (poses.empty())
        throw Error(fmt::format("calibrate camera: {}: no pose of the board fits", printable(views[v]->name)));
      bundle.T_camera_board.push_back(poses.front());
    }
    return bundle;
  } catch (const cv::Exception& error) {
    throw Error(fmt::format("calibrate camera: OpenCV: {}", error.what()));
  }
}

bool unmirror_poses(std::span<const BoardView* const> views, CameraBundle& bundle) {
  bool changed = false;
  for (std::size_t v = 0; v < views.size(); ++v) {
    try {
      for (const Pose& pose : planar_poses(to_cv(*views[v]), bundle.parameters)) {
        if (view_sum_of_squares_px2(*views[v], bundle.parameters, pose) <
            view_sum_of_squares_px2(*views[v], bundle.parameters, bundle.T_camera_board[v])) {
          bundle.T_camera_board[v] = pose;
          changed = true;
        }
      }
    } catch (const cv::Exception&) {
      continue;  // the pose that there is stays
    }
  }
  return changed;
}

}  // namespace asperity
