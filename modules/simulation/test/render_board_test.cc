#include "asperity/simulation/render_board.h"

#include <gmock/gmock.h>

#include <cmath>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "asperity/base/error.h"
#include "asperity/recording/camera_model.h"

namespace asperity {
namespace {

cv::Mat as_mat(GrayImage& image) { return cv::Mat(image.height, image.width, CV_8UC1, image.pixels.data()); }

Pose in_view(const SimulatedBoard& board, const Eigen::Vector3d& rotation_rad, double distance_m) {
  const Eigen::Quaterniond q = exp_rotation(rotation_rad);
  return {q, Eigen::Vector3d(0.0, 0.0, distance_m) - q * board_centre_m(board)};
}

// OpenCV's refined corners are good to a few hundredths of a pixel at this noise.
constexpr double kCornerTol_px = 0.15;

TEST(RenderBoard, OpenCVFindsTheCheckerboardWhereItIs) {
  const SimulatedCameraConfig config;
  const CameraCalibration camera = camera_truth(config);
  const SimulatedBoard board;
  BoardRenderer renderer(config, board);
  const Pose T = in_view(board, {0.3, -0.25, 0.1}, 0.42);
  GrayImage image;
  renderer.render(T, 0, image);
  std::vector<cv::Point2f> found;
  ASSERT_TRUE(cv::findChessboardCorners(as_mat(image), {board.columns, board.rows}, found));
  cv::cornerSubPix(as_mat(image), found, {5, 5}, {-1, -1}, {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 50, 1e-3});
  const auto corners_m = board_corners_m(board);
  ASSERT_EQ(found.size(), corners_m.size());
  // OpenCV may count from the other end.
  const auto miss_px = [&](std::size_t i, std::size_t k) {
    return (*project(camera, T * corners_m[i]) - Eigen::Vector2d(found[k].x, found[k].y)).norm();
  };
  const bool turned = miss_px(0, 0) > miss_px(0, found.size() - 1);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_LT(miss_px(i, turned ? found.size() - 1 - i : i), kCornerTol_px);
}

TEST(RenderBoard, OpenCVFindsTheCharucoBoardWhereItIs) {
  const SimulatedCameraConfig config;
  const CameraCalibration camera = camera_truth(config);
  SimulatedBoard board;
  board.charuco = true;
  board.columns = 8;
  board.rows = 6;
  board.square_m = 0.03;
  board.marker_m = 0.022;
  BoardRenderer renderer(config, board);
  const Pose T = in_view(board, {0.25, 0.2, -0.1}, 0.42);
  GrayImage image;
  renderer.render(T, 0, image);
  const cv::Ptr<cv::aruco::Dictionary> dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  const cv::Ptr<cv::aruco::CharucoBoard> model =
      cv::aruco::CharucoBoard::create(board.columns, board.rows, 0.03F, 0.022F, dictionary);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(as_mat(image), dictionary, markers, ids);
  EXPECT_EQ(ids.size(), 24U);
  cv::Mat corners, corner_ids;
  ASSERT_EQ(cv::aruco::interpolateCornersCharuco(markers, ids, as_mat(image), model, corners, corner_ids), 35);
  // OpenCV 4.6 gives ChArUco corners with the first pixel's centre at (0.5, 0.5).
  corners -= cv::Scalar(0.5, 0.5);
  cv::cornerSubPix(as_mat(image), corners, {4, 4}, {-1, -1},
                   {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 50, 1e-3});
  const auto corners_m = board_corners_m(board);
  for (int i = 0; i < corners.rows; ++i) {
    const int id = corner_ids.at<int>(i);
    const auto at = corners.at<cv::Point2f>(i);
    const Eigen::Vector2d truth_px = *project(camera, T * corners_m[static_cast<std::size_t>(id)]);
    EXPECT_LT((truth_px - Eigen::Vector2d(at.x, at.y)).norm(), kCornerTol_px) << id;
  }
  // The first corner of the first marker is its upper left one, as OpenCV draws it.
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] != 0) continue;
    const double margin_m = 0.5 * (board.square_m - board.marker_m);
    const Eigen::Vector2d truth_px = *project(camera, T * Eigen::Vector3d(board.square_m + margin_m, margin_m, 0.0));
    EXPECT_LT((truth_px - Eigen::Vector2d(markers[i][0].x, markers[i][0].y)).norm(), 2.0);
  }
}

TEST(RenderBoard, RefusesWhatItCannotDraw) {
  SimulatedBoard board;
  board.columns = 100;
  EXPECT_THROW(BoardRenderer(SimulatedCameraConfig{}, board), Error);
  board = {};
  board.charuco = true;
  board.marker_m = board.square_m;
  EXPECT_THROW(BoardRenderer(SimulatedCameraConfig{}, board), Error);
}

}  // namespace
}  // namespace asperity
