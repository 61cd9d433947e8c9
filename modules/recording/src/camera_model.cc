#include "asperity/recording/camera_model.h"

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/LU>

namespace asperity {
namespace {

struct Distorted {
  Eigen::Vector2d at;
  Eigen::Matrix2d jacobian;  // of `at` by (x, y)
};

Distorted distort_point(const CameraCalibration& camera, const Eigen::Vector2d& p) {
  std::array<double, 5> d{};
  for (std::size_t i = 0; i < d.size() && i < camera.distortion.size(); ++i) d[i] = camera.distortion[i];
  const auto [k1, k2, p1, p2, k3] = d;
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = k1 + r2 * (2.0 * k2 + 3.0 * r2 * k3);  // of `radial` by r²
  Distorted out;
  out.at = {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
            y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
  const double cross = 2.0 * x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y;
  out.jacobian << radial + 2.0 * x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, cross, cross,
      radial + 2.0 * y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return out;
}

}  // namespace

std::optional<Eigen::Vector2d> project(const CameraCalibration& camera, const Eigen::Vector3d& p_camera_m) {
  if (!(p_camera_m.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d at = distort_point(camera, p_camera_m.head<2>() / p_camera_m.z()).at;
  return Eigen::Vector2d(camera.fx * at.x() + camera.cx, camera.fy * at.y() + camera.cy);
}

std::optional<Projection> project_with_derivative(const CameraCalibration& camera, const Eigen::Vector3d& p_camera_m) {
  if (!(p_camera_m.z() > 0.0)) return std::nullopt;
  const double inverse_z = 1.0 / p_camera_m.z();
  const Eigen::Vector2d p = p_camera_m.head<2>() * inverse_z;
  const Distorted seen = distort_point(camera, p);
  Eigen::Matrix<double, 2, 3> p_by_point;
  p_by_point << inverse_z, 0.0, -p.x() * inverse_z, 0.0, inverse_z, -p.y() * inverse_z;
  const Eigen::Vector2d focal(camera.fx, camera.fy);
  return Projection{{camera.fx * seen.at.x() + camera.cx, camera.fy * seen.at.y() + camera.cy},
                    focal.asDiagonal() * seen.jacobian * p_by_point};
}

std::optional<Eigen::Vector3d> unproject(const CameraCalibration& camera, const Eigen::Vector2d& pixel) {
  constexpr int kMostSteps = 20;
  constexpr double kClose = 1e-13;  // of the tangent of the angle to the axis: 1e-10 px at any focal length
  const Eigen::Vector2d wanted((pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy);
  Eigen::Vector2d p = wanted;
  for (int i = 0; i < kMostSteps; ++i) {
    const Distorted here = distort_point(camera, p);
    const Eigen::Vector2d miss = here.at - wanted;
    // A turned-over determinant: beyond the fold of the distortion, where several rays share a pixel.
    if (!(here.jacobian.determinant() > 0.0)) return std::nullopt;
    if (miss.norm() <= kClose * (1.0 + wanted.norm())) return Eigen::Vector3d(p.x(), p.y(), 1.0);
    p -= here.jacobian.inverse() * miss;
  }
  return std::nullopt;
}

}  // namespace asperity
