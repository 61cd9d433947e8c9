#include "asperity/recording/camera_model.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "asperity/base/random.h"

namespace asperity {
namespace {

CameraCalibration bent_camera() {
  CameraCalibration camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 612.5;
  camera.fy = 608.25;
  camera.cx = 318.7;
  camera.cy = 243.1;
  camera.distortion = {-0.31, 0.12, 0.0011, -0.0007, -0.02};
  return camera;
}

Eigen::Vector2d project_by_opencv(const CameraCalibration& camera, const Eigen::Vector3d& p) {
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  std::vector<cv::Point2d> out;
  cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(), K, camera.distortion,
                    out);
  return {out[0].x, out[0].y};
}

// Points that are seen inside the image, and a little around it.
Eigen::Vector3d random_point(Random& random) {
  const double z_m = random.uniform(0.1, 2.0);
  return {z_m * random.uniform(-0.5, 0.5), z_m * random.uniform(-0.4, 0.4), z_m};
}

TEST(CameraModel, ProjectsAsOpenCv) {
  const CameraCalibration camera = bent_camera();
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = random_point(random);
    const auto pixel = project(camera, p);
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - project_by_opencv(camera, p)).norm(), 1e-9);  // px; rounding
  }
}

TEST(CameraModel, MissingCoefficientsAreZero) {
  CameraCalibration camera = bent_camera();
  const Eigen::Vector3d p(0.1, -0.05, 0.4);
  camera.distortion = {-0.31, 0.12};
  const Eigen::Vector2d two = *project(camera, p);
  camera.distortion = {-0.31, 0.12, 0.0, 0.0, 0.0};
  EXPECT_EQ(two, *project(camera, p));
}

TEST(CameraModel, UnprojectIsTheInverse) {
  const CameraCalibration camera = bent_camera();
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = random_point(random);
    const auto ray = unproject(camera, *project(camera, p));
    ASSERT_TRUE(ray);
    EXPECT_LT((*ray - p / p.z()).norm(), 1e-12);
  }
}

TEST(CameraModel, DerivativeIsThatOfSmallSteps) {
  const CameraCalibration camera = bent_camera();
  Random random(3);
  constexpr double kStep_m = 1e-6;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p = random_point(random);
    const auto seen = project_with_derivative(camera, p);
    ASSERT_TRUE(seen);
    EXPECT_LT((seen->pixel - *project(camera, p)).norm(), 1e-10);  // px; rounding
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector2d slope = (*project(camera, p + step) - *project(camera, p - step)) / (2.0 * kStep_m);
      // Central differences: px/m, some 1e3 to 1e4 large.
      EXPECT_LT((slope - seen->by_point.col(axis)).norm(), 1e-4);
    }
  }
}

TEST(CameraModel, NothingBehindTheCameraIsSeen) {
  const CameraCalibration camera = bent_camera();
  EXPECT_FALSE(project(camera, {0.0, 0.0, -1.0}));
  EXPECT_FALSE(project(camera, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(project_with_derivative(camera, {0.1, 0.0, -0.1}));
}

TEST(CameraModel, APixelBeyondTheFoldHasNoRay) {
  CameraCalibration camera = bent_camera();
  camera.distortion = {-0.5, 0.0, 0.0, 0.0, 0.0};
  // r − 0.5 r³ has its maximum 0.544 at r = 0.816: nothing is seen farther out.
  EXPECT_TRUE(unproject(camera, {camera.cx + 0.53 * camera.fx, camera.cy}));
  EXPECT_FALSE(unproject(camera, {camera.cx + 0.56 * camera.fx, camera.cy}));
}

}  // namespace
}  // namespace asperity
