#pragma once

#include <optional>

#include <Eigen/Core>

#include "asperity/recording/calibration.h"

namespace asperity {

// The pinhole camera with radial and tangential distortion (Brown, 1966), in OpenCV's terms: with
// x = X/Z, y = Y/Z and r² = x² + y²,
//   x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²)
//   y' = y (1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2 y²) + 2 p2 x y
// and the pixel is (fx x' + cx, fy y' + cy); the centre of the first pixel is (0, 0). Camera axes: x
// right, y down, z forward. Missing coefficients are zero.

// The pixel at which `p_camera_m` is seen; nullopt for a point that is not in front of the camera.
std::optional<Eigen::Vector2d> project(const CameraCalibration& camera, const Eigen::Vector3d& p_camera_m);

// A pixel and how it moves with the point.
struct Projection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_point;  // px per metre of p_camera_m
};

// The same with its derivative.
std::optional<Projection> project_with_derivative(const CameraCalibration& camera, const Eigen::Vector3d& p_camera_m);

// The point (x, y, 1) of the ray through `pixel`, by Newton's method from the pixel without distortion;
// nullopt where the distortion has no inverse near.
std::optional<Eigen::Vector3d> unproject(const CameraCalibration& camera, const Eigen::Vector2d& pixel);

}  // namespace asperity
