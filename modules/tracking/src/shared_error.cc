#include "shared_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Cholesky>

#include "asperity/recording/camera_model.h"

namespace asperity {
namespace {

// The pixel's derivative by fx, fy, cx, cy, k1, k2, p1, p2, k3 (camera_model.h).
Eigen::Matrix<double, 2, 9> pixel_by_camera(const CameraCalibration& camera, const Eigen::Vector3d& p_camera_m,
                                            const Eigen::Vector2d& pixel) {
  const double x = p_camera_m.x() / p_camera_m.z(), y = p_camera_m.y() / p_camera_m.z(), r2 = x * x + y * y;
  Eigen::Matrix<double, 2, 9> out;
  out.row(0) << (pixel.x() - camera.cx) / camera.fx, 0.0, 1.0, 0.0, camera.fx * x * r2, camera.fx * x * r2 * r2,
      camera.fx * 2.0 * x * y, camera.fx * (r2 + 2.0 * x * x), camera.fx * x * r2 * r2 * r2;
  out.row(1) << 0.0, (pixel.y() - camera.cy) / camera.fy, 0.0, 1.0, camera.fy * y * r2, camera.fy * y * r2 * r2,
      camera.fy * (r2 + 2.0 * y * y), camera.fy * 2.0 * x * y, camera.fy * y * r2 * r2 * r2;
  return out;
}

// A root L of a covariance L Lᵀ, singular ones too.
Eigen::Matrix<double, 9, 9> root_of(const Eigen::Matrix<double, 9, 9>& covariance) {
  const Eigen::LDLT<Eigen::Matrix<double, 9, 9>> factor(covariance);
  Eigen::Matrix<double, 9, 9> out = factor.matrixL();
  out = (out * factor.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal()).eval();
  return factor.transpositionsP().transpose() * out;
}

// Tags of one plane: which of those seen, the plane's axes, its middle and half of its greater extent.
struct Plane {
  std::vector<std::size_t> seen;
  Eigen::Matrix3d axes;  // in the marker frame; the third is the normal
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  double half_m = 0.0;
};

std::vector<Plane> planes_of(const std::vector<MarkerPlacement>& body, std::span<const CornersAtPose> corners,
                             std::span<const std::size_t> tag_of) {
  constexpr double kParallel = 0.999;  // cosine: 2.6°
  std::vector<Plane> out;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Matrix3d axes = body[tag_of[i]].T_marker_tag.rotation.toRotationMatrix();
    const Eigen::Vector3d centre_m = corners[i].p_marker_m.rowwise().mean();
    const double off_plane_m = 0.1 * body[tag_of[i]].size_m;
    const auto same = std::find_if(out.begin(), out.end(), [&](const Plane& plane) {
      const Eigen::Vector3d there_m = corners[plane.seen.front()].p_marker_m.rowwise().mean();
      const Eigen::Vector3d normal = plane.axes.col(2);
      return axes.col(2).dot(normal) > kParallel && std::abs(normal.dot(centre_m - there_m)) < off_plane_m;
    });
    Plane& plane = same == out.end() ? out.emplace_back() : *same;
    if (plane.seen.empty()) plane.axes = axes;
    plane.seen.push_back(i);
  }
  for (Plane& plane : out) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
    for (const std::size_t i : plane.seen) {
      const Eigen::Matrix<double, 3, 4> local_m = plane.axes.transpose() * corners[i].p_marker_m;
      low = low.cwiseMin(local_m.rowwise().minCoeff());
      high = high.cwiseMax(local_m.rowwise().maxCoeff());
    }
    plane.middle_m = plane.axes * (0.5 * (low + high));
    plane.half_m = 0.5 * (high - low).head<2>().maxCoeff();
  }
  return out;
}

}  // namespace

Eigen::Matrix<double, 9, 9> camera_covariance(const CameraCalibration& camera, const BodyPoseConfig& config) {
  if (camera.covariance) return *camera.covariance;
  const auto square = [](double x) { return x * x; };
  Eigen::Matrix<double, 9, 9> out = Eigen::Matrix<double, 9, 9>::Zero();
  const Eigen::Vector2d focal(camera.fx, camera.fy);
  constexpr double kAspect = 1.0 / 3.0, kTangential = 0.05;
  out.topLeftCorner<2, 2>() = square(config.focal_error) * focal * focal.transpose();
  out(1, 1) += square(kAspect * config.focal_error * camera.fy);
  out(2, 2) = out(3, 3) = square(config.focal_error * camera.fx);
  out(4, 4) = square(config.distortion_error);
  out(6, 6) = out(7, 7) = square(kTangential * config.distortion_error);
  return out;
}

std::vector<SharedColumns> shared_columns(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                                          const Pose& pose, std::span<const CornersAtPose> corners,
                                          std::span<const std::size_t> tag_of, const BodyPoseConfig& config) {
  constexpr Eigen::Index kCamera = 9, kScale = 1, kBends = 3;
  const std::vector<Plane> planes = planes_of(body, corners, tag_of);
  const Eigen::Index count = kCamera + kScale + kBends * static_cast<Eigen::Index>(planes.size());
  std::vector<SharedColumns> out(corners.size(), SharedColumns::Zero(8, count));
  const Eigen::Matrix<double, 9, 9> root = root_of(camera_covariance(camera, config));
  const Eigen::Matrix3d R = pose.rotation.toRotationMatrix();
  // by_pose holds the pixel's derivative by the translation, which is that by the point.
  const auto by_point = [&](std::size_t i, int corner) {
    return Eigen::Matrix<double, 2, 3>(corners[i].by_pose.block<2, 3>(2 * corner, 0) * R);
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d p_camera_m = pose * corners[i].p_marker_m.col(k);
      const auto seen = project(camera, p_camera_m);
      if (!seen) continue;
      out[i].block<2, kCamera>(2 * k, 0) = pixel_by_camera(camera, p_camera_m, *seen) * root;
      out[i].block<2, kScale>(2 * k, kCamera) =
          config.print_scale_error * by_point(i, k) * corners[i].p_marker_m.col(k);
    }
  }
  // A plane's sag: z = σ (x², y², √2 xy) / half², x and y from its middle.
  Eigen::Index first = kCamera + kScale;
  for (const Plane& plane : planes) {
    const double sigma_m = config.bend_share * 2.0 * plane.half_m;
    for (const std::size_t i : plane.seen) {
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d at =
            plane.axes.transpose() * (corners[i].p_marker_m.col(k) - plane.middle_m) / plane.half_m;
        out[i].block<2, kBends>(2 * k, first) =
            sigma_m * (by_point(i, k) * plane.axes.col(2)) *
            Eigen::RowVector3d(at.x() * at.x(), at.y() * at.y(), std::sqrt(2.0) * at.x() * at.y());
      }
    }
    first += kBends;
  }
  return out;
}

}  // namespace asperity
