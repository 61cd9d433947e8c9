#include "asperity/calibration/calibrate_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "asperity/base/error.h"
#include "coverage.h"
#include "simulated_board.h"

namespace asperity {
namespace {

using test::BoardViewOptions;

const CalibrationBoard kBoard;

std::string refusal(const std::vector<BoardView>& views) {
  try {
    calibrate_camera(views, 640, 480);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void add_all(test::Coverage& coverage, const CameraFit& fit, const CameraCalibration& truth) {
  const CameraVector found = camera_parameters(fit.camera), expected = camera_parameters(truth);
  for (std::size_t k = 0; k < kCameraParameters; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (fit.standard_error[i] > 0.0)
      coverage.add(std::string(kCameraParameterNames[k]), found[i], expected[i], fit.standard_error[i]);
  }
}

constexpr std::size_t kTrials = 200;

TEST(CalibrateCamera, StandardErrorsAreTrue) {
  test::Coverage coverage;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(11, trial);
    const CameraFit fit = calibrate_camera(test::simulated_views(random, test::true_camera(), kBoard, 15), 640, 480,
                                           {.k3 = ThirdRadialTerm::kZero});
    EXPECT_TRUE(fit.converged);
    add_all(coverage, fit, test::true_camera());
  }
  coverage.expect("camera, independent corners", kTrials);
}

TEST(CalibrateCamera, StandardErrorsAreTrueWithTheModelChosen) {
  test::Coverage coverage;
  std::size_t k3_free = 0;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(12, trial);
    const CameraFit fit = calibrate_camera(test::simulated_views(random, test::true_camera(), kBoard, 15), 640, 480);
    CameraFit all = fit;
    all.standard_error[8] = 0.0;
    k3_free += fit.k3_free;
    add_all(coverage, all, test::true_camera());
  }
  std::printf("k3 chosen in %zu of %zu\n", k3_free, kTrials);
  coverage.expect("camera, model chosen", kTrials);
}

TEST(CalibrateCamera, StandardErrorsAreTrueWithAThirdRadialTerm) {
  CameraCalibration camera = test::true_camera();
  camera.distortion[4] = 0.1;
  test::Coverage coverage;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(13, trial);
    const CameraFit fit =
        calibrate_camera(test::simulated_views(random, camera, kBoard, 15), 640, 480, {.k3 = ThirdRadialTerm::kFree});
    add_all(coverage, fit, camera);
  }
  coverage.expect("camera, k3 free", kTrials);
}

TEST(CalibrateCamera, ErrorsSharedWithinAViewMakeTheStandardErrorsLarger) {
  test::Coverage coverage;
  std::size_t scaled = 0;
  double dispersion = 0.0;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    Random random(14, trial);
    const CameraFit fit = calibrate_camera(
        test::simulated_views(random, test::true_camera(), kBoard, 15, {.noise_px = 0.1, .view_bias_px = 0.06}), 640,
        480, {.k3 = ThirdRadialTerm::kZero});
    scaled += fit.errors_scaled;
    dispersion += fit.dispersion / kTrials;
    add_all(coverage, fit, test::true_camera());
  }
  std::printf("scaled in %zu, dispersion %.2f\n", scaled, dispersion);
  coverage.expect("camera, corners that err together", kTrials);
}

TEST(CalibrateCamera, RefusesTooFewViews) {
  Random random(20);
  EXPECT_THAT(refusal(test::simulated_views(random, test::true_camera(), kBoard, 5)),
              testing::HasSubstr("5 views of the board, at least 8"));
}

TEST(CalibrateCamera, RefusesABoardThatWasAlwaysFrontal) {
  Random random(21);
  const BoardViewOptions frontal{.least_tilt_rad = 0.0, .most_tilt_rad = 0.03};
  EXPECT_THAT(refusal(test::simulated_views(random, test::true_camera(), kBoard, 15, frontal)),
              testing::HasSubstr("tilted by 20 to 45 degrees"));
}

TEST(CalibrateCamera, RefusesABoardAlwaysInOneCorner) {
  Random random(22);
  CalibrationBoard small = kBoard;
  small.square_m = 0.012;
  std::vector<BoardView> views;
  const CameraCalibration camera = test::true_camera();
  while (views.size() < 15) {
    const BoardView view = test::simulated_views(random, camera, small, 1, {.nearest_m = 0.5})[0];
    const auto in_corner = [](const Eigen::Vector2d& p) { return p.x() < 300.0 && p.y() < 230.0; };
    if (std::all_of(view.corner_px.begin(), view.corner_px.end(), in_corner)) views.push_back(view);
  }
  EXPECT_THAT(refusal(views), testing::HasSubstr("always in one part of the image"));
}

TEST(CalibrateCamera, RefusesACornerOutsideTheImage) {
  Random random(23);
  auto views = test::simulated_views(random, test::true_camera(), kBoard, 10);
  views[3].corner_px[2].x() = 700.0;
  EXPECT_THAT(refusal(views), testing::HasSubstr("view 3: corner (700,"));
}

TEST(CalibrateCamera, LeavesOutAViewThatDisagrees) {
  Random random(24);
  auto views = test::simulated_views(random, test::true_camera(), kBoard, 25);
  for (std::size_t i = 0; i < views[6].corner_px.size(); i += 3) views[6].corner_px[i].y() += 3.0;
  const CameraFit fit = calibrate_camera(views, 640, 480);
  ASSERT_EQ(fit.problems.size(), 1u);
  EXPECT_THAT(fit.problems[0].message, testing::HasSubstr("view 6"));
  EXPECT_EQ(fit.views.size(), 25u);
  EXPECT_FALSE(fit.views.back().used);
  const CameraVector z = (camera_parameters(fit.camera) - camera_parameters(test::true_camera()));
  EXPECT_LT(std::abs(z[0]), 4.0 * fit.standard_error[0]);
  EXPECT_TRUE(fit.verdict.trustworthy) << fit.verdict.text;
}

// A camera of another size of board: the unit of length cancels.
TEST(CalibrateCamera, AScaledBoardGivesTheSameCamera) {
  Random random(25);
  auto views = test::simulated_views(random, test::true_camera(), kBoard, 12);
  const CameraFit fit = calibrate_camera(views, 640, 480);
  for (BoardView& view : views) {
    for (Eigen::Vector3d& p : view.p_board_m) p *= 1024.0;
  }
  const CameraFit scaled = calibrate_camera(views, 640, 480);
  EXPECT_NEAR(scaled.camera.fx, fit.camera.fx, 1e-4 * fit.standard_error[0]);
  EXPECT_NEAR(scaled.standard_error[0], fit.standard_error[0], 1e-4 * fit.standard_error[0]);
}

// A camera that is right is not invalid because the board has not been everywhere (Bouguet's own images
// cover 47 %, and give fx to 0.003 % of his value).
TEST(CalibrateCamera, ABoardThatWasNotEverywhereLimits) {
  Random random(29);
  const auto views = test::simulated_views(random, test::true_camera(), kBoard, 12);
  const CameraFit fit = calibrate_camera(views, 640, 480, {.good_coverage = 0.999});
  EXPECT_LT(fit.coverage, 0.999);
  ASSERT_EQ(fit.verdict.verdicts.size(), 1u);
  EXPECT_EQ(fit.verdict.verdicts[0].code, "board_coverage");
  EXPECT_EQ(fit.verdict.verdicts[0].severity, Severity::kLimited);
  EXPECT_FALSE(fit.verdict.verdicts[0].remedy.empty());
  EXPECT_TRUE(fit.verdict.trustworthy);
  EXPECT_THAT(fit.verdict.text, testing::HasSubstr("of the image only"));
  ASSERT_TRUE(fit.camera.covariance);
  EXPECT_DOUBLE_EQ((*fit.camera.covariance)(0, 0), fit.standard_error[0] * fit.standard_error[0]);
}

// OpenCV's optimum is another implementation's; its own standard errors are √2 too large: it divides by the number of
// corners, not of coordinates.
TEST(CalibrateCamera, AgreesWithOpenCv) {
  Random random(26);
  const auto views = test::simulated_views(random, test::true_camera(), kBoard, 12);
  const CameraFit fit = calibrate_camera(views, 640, 480, {.k3 = ThirdRadialTerm::kFree});
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> pixel;
  for (const BoardView& view : views) {
    board.emplace_back();
    pixel.emplace_back();
    for (std::size_t i = 0; i < view.corner_px.size(); ++i) {
      board.back().emplace_back(static_cast<float>(view.p_board_m[i].x()), static_cast<float>(view.p_board_m[i].y()),
                                0.0F);
      pixel.back().emplace_back(static_cast<float>(view.corner_px[i].x()), static_cast<float>(view.corner_px[i].y()));
    }
  }
  cv::Mat matrix, distortion, intrinsic_errors, extrinsic_errors, view_errors;
  std::vector<cv::Mat> rotations, translations;
  const double rms = cv::calibrateCamera(board, pixel, {640, 480}, matrix, distortion, rotations, translations,
                                         intrinsic_errors, extrinsic_errors, view_errors, 0,
                                         cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-12));
  EXPECT_NEAR(fit.rms_px, rms, 1e-4);
  EXPECT_NEAR(fit.camera.fx, matrix.at<double>(0, 0), 0.05 * fit.standard_error[0]);
  EXPECT_NEAR(fit.camera.cy, matrix.at<double>(1, 2), 0.05 * fit.standard_error[3]);
  EXPECT_NEAR(fit.camera.distortion[0], distortion.at<double>(0), 0.05 * fit.standard_error[4]);
  EXPECT_GT(intrinsic_errors.at<double>(0), 1.3 * fit.standard_error[0]);
}

}  // namespace
}  // namespace asperity
