#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/recording/camera_model.h"
#include "asperity/tracking/solve_body_pose.h"

// Bodies of tags as a camera sees them.
namespace asperity::test {

using Vector6 = Eigen::Matrix<double, 6, 1>;

inline constexpr double kDegree = std::numbers::pi / 180.0;

inline CameraCalibration camera_640() {
  CameraCalibration camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 603.0;
  camera.fy = 601.5;
  camera.cx = 322.7;
  camera.cy = 236.1;
  camera.distortion = {-0.24, 0.09, 0.0006, -0.0008, 0.0};
  return camera;
}

// A camera and a body of which nothing is unknown: what is left is the frame's own noise.
inline CameraCalibration known(CameraCalibration camera) {
  camera.covariance = Eigen::Matrix<double, 9, 9>::Zero();
  return camera;
}
inline BodyPoseConfig known_body() {
  BodyPoseConfig out;
  out.print_scale_error = out.bend_share = 0.0;
  return out;
}

inline MarkerPlacement tag_at(int id, const Pose& T_marker_tag) { return {id, "tag36h11", 0.046, T_marker_tag}; }

inline std::vector<MarkerPlacement> flat_pair() {
  return {tag_at(0, {Eigen::Quaterniond::Identity(), {0.0, -0.029, 0.0}}),
          tag_at(1, {Eigen::Quaterniond::Identity(), {0.0, 0.029, 0.0}})};
}

// Tags on neighbouring sides of a sleeve about y.
inline std::vector<MarkerPlacement> sleeve(int sides) {
  std::vector<MarkerPlacement> out;
  for (int i = 0; i < sides; ++i) {
    const Eigen::Quaterniond turn = exp_rotation({0.0, (i - 0.5 * (sides - 1)) * 40.0 * kDegree, 0.0});
    out.push_back(tag_at(i, {turn, turn * Eigen::Vector3d(0.0, 0.0, -0.06)}));
  }
  return out;
}

inline std::vector<SeenTag> see(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                                const Pose& truth, double sigma_px = 0.0, Random* random = nullptr) {
  std::vector<SeenTag> out;
  for (std::size_t t = 0; t < body.size(); ++t) {
    SeenTag tag;
    tag.tag = t;
    const Eigen::Matrix<double, 3, 4> corners_m = tag_corners_m(body[t]);
    for (int i = 0; i < 4; ++i) {
      tag.corners_px.col(i) = *project(camera, truth * corners_m.col(i));
      if (random) tag.corners_px.col(i) += sigma_px * Eigen::Vector2d(random->normal(), random->normal());
    }
    out.push_back(tag);
  }
  return out;
}

inline Pose tilted(double x_deg, double y_deg, double z_deg, const Eigen::Vector3d& at_m) {
  return {exp_rotation({x_deg * kDegree, 0, 0}) * exp_rotation({0, y_deg * kDegree, 0}) *
              exp_rotation({0, 0, z_deg * kDegree}),
          at_m};
}

inline Vector6 error_of(const Pose& found, const Pose& truth) {
  Vector6 e;
  e << found.translation_m - truth.translation_m, log_rotation(found.rotation * truth.rotation.conjugate());
  return e;
}

}  // namespace asperity::test
