#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/calibration/calibrate_camera.h"
#include "asperity/calibration/find_board.h"
#include "asperity/recording/camera_model.h"
#include "asperity/simulation/render_board.h"

namespace asperity {
namespace {

// The board tilted by 12 to 45 degrees, whole in the image.
Pose random_pose(Random& random, const CameraCalibration& camera, const SimulatedBoard& board) {
  const Eigen::Vector3d centre = board_centre_m(board);
  for (;;) {
    const double azimuth = random.uniform(0.0, 6.283185307179586), tilt = random.uniform(0.2, 0.8);
    Pose pose;
    pose.rotation = exp_rotation(tilt * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0)) *
                    exp_rotation({0.0, 0.0, random.uniform(-0.4, 0.4)});
    const double z = random.uniform(0.3, 0.55);
    const Eigen::Vector3d at(random.uniform(-0.5, 0.5) * camera.width / camera.fx * z,
                             random.uniform(-0.5, 0.5) * camera.height / camera.fy * z, z);
    pose.translation_m = at - pose.rotation * centre;
    bool inside = true;
    for (const Eigen::Vector3d& p : board_corners_m(board)) {
      const auto pixel = project(camera, pose * (centre + 1.35 * (p - centre)));
      inside = inside && pixel && pixel->x() > 4.0 && pixel->y() > 4.0 && pixel->x() < camera.width - 5.0 &&
               pixel->y() < camera.height - 5.0;
    }
    if (inside) return pose;
  }
}

// What the whole chain gives: the bench's lens, blur by depth, shading, noise and clutter; the finder; the fit.
void expect_the_camera_back(const SimulatedBoard& drawn, const CalibrationBoard& board, std::uint64_t seed) {
  const SimulatedCameraConfig config;
  const CameraCalibration truth = camera_truth(config);
  BoardRenderer renderer(config, drawn);
  Random random(seed);
  std::vector<BoardView> views;
  GrayImage image;
  constexpr std::uint64_t kViews = 20;
  for (std::uint64_t i = 0; i < kViews; ++i) {
    const Pose pose = random_pose(random, truth, drawn);
    renderer.render(pose, i, image);
    if (auto view = find_board(image, board)) views.push_back(*view);
  }
  ASSERT_GE(views.size(), 16u);
  const CameraFit fit = calibrate_camera(views, config.width, config.height);
  const CameraVector found = camera_parameters(fit.camera), expected = camera_parameters(truth);
  for (std::size_t k = 0; k < kCameraParameters; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    std::printf("%s %.6g ± %.2g, true %.6g\n", std::string(kCameraParameterNames[k]).c_str(), found[i],
                fit.standard_error[i], expected[i]);
    // Of nine normal deviates one in forty calibrations has one beyond 3; a bias shows by more.
    EXPECT_LE(std::abs(found[i] - expected[i]), 3.5 * fit.standard_error[i]) << kCameraParameterNames[k];
  }
  std::printf("%zu views, corners %.3f px, dispersion %.2f ± %.2f; %s\n", views.size(), fit.corner_sigma_px,
              fit.dispersion, fit.dispersion_error, fit.verdict.text.c_str());
  EXPECT_TRUE(fit.verdict.trustworthy) << fit.verdict.text;
  EXPECT_LT(fit.rms_px, 0.15);
}

TEST(RenderedBoards, ACheckerboardGivesTheCameraBack) {
  expect_the_camera_back({}, {BoardKind::kCheckerboard, 9, 6, 0.025, 0.0, ""}, 5);
}

TEST(RenderedBoards, ACharucoBoardGivesTheCameraBack) {
  expect_the_camera_back({true, 10, 7, 0.025, 0.018}, {BoardKind::kCharuco, 10, 7, 0.025, 0.018, "DICT_APRILTAG_36h11"},
                         6);
}

}  // namespace
}  // namespace asperity
