#include "asperity/calibration/find_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/aruco/charuco.hpp>

#include "asperity/base/error.h"
#include "asperity/calibration/calibrate_camera.h"
#include "render_board.h"
#include "simulated_board.h"

namespace asperity {
namespace {

const CalibrationBoard kBoard;

// Mean and scatter of found minus true over all corners, matched by the nearest.
struct CornerErrors {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double rms_px = 0.0;  // of one coordinate
  double worst_px = 0.0;
  int corners = 0;

  void add(const BoardView& view, const CameraCalibration& camera, const Pose& T_camera_board) {
    for (const Eigen::Vector2d& found : view.corner_px) {
      Eigen::Vector2d nearest(1e9, 1e9);
      for (const Eigen::Vector3d& p : view.p_board_m) {
        const Eigen::Vector2d error = found - *project(camera, T_camera_board * p);
        if (error.norm() < nearest.norm()) nearest = error;
      }
      mean += nearest;
      rms_px += nearest.squaredNorm();
      worst_px = std::max(worst_px, nearest.norm());
      ++corners;
    }
  }
  void finish() {
    mean /= corners;
    rms_px = std::sqrt(rms_px / (2.0 * corners));
  }
};

struct Found {
  CornerErrors errors;
  int views = 0;
};

Found find_rendered(const test::RenderOptions& options, const FindBoardConfig& config, std::uint64_t views) {
  Found out;
  for (std::uint64_t i = 0; i < views; ++i) {
    Random random(30, i);
    const Pose pose = test::random_board_pose(random, test::true_camera(), kBoard, {});
    const GrayImage image = test::render_checkerboard(random, test::true_camera(), kBoard, pose, options);
    const auto view = find_board(image, kBoard, config);
    if (!view) continue;
    ++out.views;
    out.errors.add(*view, test::true_camera(), pose);
  }
  out.errors.finish();
  return out;
}

// Errors that all corners share would go into the camera; the tolerance is a few times their standard error
// (0.05 px / √216).
TEST(FindBoard, CornersAreUnbiasedAndBetterThanTheSectorBasedOnes) {
  constexpr double kBiasTol_px = 0.015;
  const Found sub_pixel = find_rendered({}, {}, 4);
  const Found sector_based = find_rendered({}, {.method = CornerMethod::kSectorBased}, 4);
  for (const auto& [name, found] : {std::pair{"sub_pixel", sub_pixel}, {"sector_based", sector_based}}) {
    std::printf("%s: mean (%.4f, %.4f), rms %.4f, worst %.4f px\n", name, found.errors.mean.x(), found.errors.mean.y(),
                found.errors.rms_px, found.errors.worst_px);
    EXPECT_EQ(found.views, 4);
  }
  EXPECT_LT(sub_pixel.errors.mean.norm(), kBiasTol_px);
  EXPECT_LT(sub_pixel.errors.rms_px, 0.06);
  EXPECT_LT(sub_pixel.errors.worst_px, 0.25);
  EXPECT_LT(sub_pixel.errors.rms_px, sector_based.errors.rms_px);
}

TEST(FindBoard, RenderedImagesGiveTheCameraBack) {
  std::vector<BoardView> views;
  for (std::uint64_t i = 0; i < 12; ++i) {
    Random random(31, i);
    const Pose pose = test::random_board_pose(random, test::true_camera(), kBoard, {});
    const auto view = find_board(test::render_checkerboard(random, test::true_camera(), kBoard, pose), kBoard);
    if (view) views.push_back(*view);
  }
  ASSERT_GE(views.size(), 11u);
  const CameraFit fit = calibrate_camera(views, 640, 480);
  EXPECT_LT(fit.rms_px, 0.1);
  const CameraVector error = camera_parameters(fit.camera) - camera_parameters(test::true_camera());
  for (std::size_t k = 0; k < kCameraParameters; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    std::printf("%s %g ± %g, true %g\n", std::string(kCameraParameterNames[k]).c_str(),
                camera_parameters(fit.camera)[i], fit.standard_error[i], camera_parameters(test::true_camera())[i]);
    EXPECT_LE(std::abs(error[i]), 3.5 * fit.standard_error[i]) << kCameraParameterNames[k];
  }
  std::printf("dispersion %.2f ± %.2f, corners %.3f px\n", fit.dispersion, fit.dispersion_error, fit.corner_sigma_px);
}

TEST(FindBoard, CharucoCornersAreUnbiased) {
  const CalibrationBoard board{BoardKind::kCharuco, 9, 6, 0.025, 0.018, "DICT_4X4_50"};
  const auto pattern =
      cv::aruco::CharucoBoard::create(9, 6, 0.025F, 0.018F, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50));
  cv::Mat drawn;
  constexpr double kDots_m = 1.0 / 8000.0;
  pattern->draw({1800, 1200}, drawn, 0, 1);
  const auto paint = [&](double x_m, double y_m) {
    // The first inner corner is one square from the drawing's edges.
    const double column = (x_m + board.square_m) / kDots_m, row = (y_m + board.square_m) / kDots_m;
    if (column < 0.0 || row < 0.0 || column >= 1800.0 || row >= 1200.0) return 200.0;
    return 40.0 + 160.0 / 255.0 * drawn.at<std::uint8_t>(static_cast<int>(row), static_cast<int>(column));
  };
  CornerErrors errors;
  for (std::uint64_t i = 0; i < 3; ++i) {
    Random random(32, i);
    const Pose pose = test::random_board_pose(random, test::true_camera(), board, {});
    const auto view = find_board(test::render_plane(random, test::true_camera(), pose, paint, {}), board);
    ASSERT_TRUE(view);
    EXPECT_GE(view->corner_px.size(), 35u);
    errors.add(*view, test::true_camera(), pose);
    // Each corner is where it says on the board, not only near some corner.
    for (std::size_t k = 0; k < view->corner_px.size(); ++k) {
      EXPECT_LT((*project(test::true_camera(), pose * view->p_board_m[k]) - view->corner_px[k]).norm(), 0.5);
    }
  }
  errors.finish();
  std::printf("charuco: mean (%.4f, %.4f), rms %.4f, worst %.4f px of %d\n", errors.mean.x(), errors.mean.y(),
              errors.rms_px, errors.worst_px, errors.corners);
  EXPECT_LT(errors.mean.norm(), 0.02);
  EXPECT_LT(errors.rms_px, 0.08);
}

TEST(FindBoard, NoBoardNoView) {
  Random random(33);
  GrayImage image{320, 240, std::vector<std::uint8_t>(320 * 240, 128)};
  for (auto& pixel : image.pixels) pixel = static_cast<std::uint8_t>(random.uniform(100.0, 150.0));
  EXPECT_FALSE(find_board(image, kBoard));
  EXPECT_FALSE(find_board(image, {BoardKind::kCharuco, 9, 6, 0.025, 0.018, "DICT_4X4_50"}));
}

TEST(FindBoard, RefusesBadBoardsAndImages) {
  const GrayImage image{4, 4, std::vector<std::uint8_t>(16)};
  EXPECT_THROW(find_board({4, 4, {}}, kBoard), Error);
  EXPECT_THROW(find_board({-4, -4, std::vector<std::uint8_t>(16)}, kBoard), Error);
  EXPECT_THROW(find_board(image, kBoard, {.largest_megapixels = 1e-6}), Error);
  EXPECT_THROW(find_board(image, {BoardKind::kCheckerboard, 2, 6, 0.025, 0.0, ""}), Error);
  EXPECT_THROW(find_board(image, {BoardKind::kCheckerboard, 9, 6000, 0.025, 0.0, ""}), Error);
  EXPECT_THROW(find_board(image, {BoardKind::kCheckerboard, 9, 6, -1.0, 0.0, ""}), Error);
  EXPECT_THROW(find_board(image, {BoardKind::kCharuco, 9, 6, 0.025, 0.03, "DICT_4X4_50"}), Error);
  EXPECT_THROW(find_board(image, {BoardKind::kCharuco, 9, 6, 0.025, 0.018, "DICT_\x1b[2J"}), Error);
  EXPECT_THROW(find_board(image, {BoardKind::kCharuco, 30, 30, 0.025, 0.018, "DICT_4X4_50"}), Error);
}

}  // namespace
}  // namespace asperity
