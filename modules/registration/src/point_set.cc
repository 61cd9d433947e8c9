#include "point_set.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "asperity/base/error.h"

namespace asperity::registration {
namespace {

constexpr double kThickness = 0.1;

}  // namespace

PointSet gather_points(std::span<const MeasuredPath> paths, Problems& problems) {
  if (paths.empty()) throw Error("registration: no path");
  std::size_t total = 0;
  for (const MeasuredPath& path : paths) total += path.p_world_m.size();
  PointSet out;
  out.x_m.reserve(total);
  out.outward.reserve(total);
  out.s_m.reserve(total);
  out.path.reserve(total);

  double s_m = 0.0;
  double sigma_sum = 0.0;
  std::size_t bad = 0;
  std::array<std::size_t, 2> first_bad{};
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const MeasuredPath& path = paths[k];
    if (!path.outward_world.empty() && path.outward_world.size() != path.p_world_m.size()) {
      throw Error(fmt::format("registration: path {} has {} points and {} outward directions", k, path.p_world_m.size(),
                              path.outward_world.size()));
    }
    if (!(path.sigma_m >= 0.0) || !std::isfinite(path.sigma_m)) {
      throw Error(fmt::format("registration: path {}: sigma_m is {}", k, path.sigma_m));
    }
    bool first = true;
    for (std::size_t i = 0; i < path.p_world_m.size(); ++i) {
      if (!path.p_world_m[i].allFinite()) {
        if (bad++ == 0) first_bad = {k, i};
        continue;
      }
      if (!first) s_m += (path.p_world_m[i] - out.x_m.back()).norm();
      first = false;
      out.x_m.push_back(path.p_world_m[i]);
      out.s_m.push_back(s_m);
      out.path.push_back(static_cast<std::uint32_t>(k));
      Eigen::Vector3d outward = Eigen::Vector3d::Zero();
      if (!path.outward_world.empty() && path.outward_world[i].allFinite() && path.outward_world[i].norm() > 0.0) {
        outward = path.outward_world[i].normalized();
      }
      out.outward.push_back(outward);
      sigma_sum += path.sigma_m;
    }
  }
  if (out.size() < 3) {
    throw Error(fmt::format(
        "registration: {} finite points; three are needed{}", out.size(),
        bad == 0 ? std::string()
                 : fmt::format(" (the first that is not finite: path {}, point {})", first_bad[0], first_bad[1])));
  }
  if (bad > 0) {
    problems.push_back({"not_finite_points",
                        fmt::format("points that are not finite were left out, the first of them path {}, point {}",
                                    first_bad[0], first_bad[1]),
                        bad});
  }
  for (const Eigen::Vector3d& p : out.x_m) out.mean_world_m += p;
  out.mean_world_m /= static_cast<double>(out.size());
  double square = 0.0;
  for (Eigen::Vector3d& p : out.x_m) {
    p -= out.mean_world_m;
    out.scatter_m2 += p * p.transpose();
    square += p.squaredNorm();
  }
  out.radius_m = std::sqrt(square / static_cast<double>(out.size()));
  if (!(out.radius_m > 0.0) || !std::isfinite(out.radius_m)) {
    throw Error("registration: all points of the path coincide, or are too far apart for their squares");
  }
  out.scatter_m2 /= static_cast<double>(out.size());
  out.sigma_m = sigma_sum / static_cast<double>(out.size());
  return out;
}

CentredPose centred(const Pose& T_mesh_world, const PointSet& points) {
  return {T_mesh_world.rotation.normalized(), T_mesh_world * points.mean_world_m};
}

Pose uncentred(const CentredPose& pose, const PointSet& points) {
  return {pose.rotation, pose.centre_m - pose.rotation * points.mean_world_m};
}

CentredPose moved(const CentredPose& pose, const Eigen::Matrix<double, 6, 1>& motion) {
  return {(exp_rotation(motion.head<3>()) * pose.rotation).normalized(), pose.centre_m + motion.tail<3>()};
}

Eigen::Matrix<double, 6, 1> motion_between(const CentredPose& from, const CentredPose& to) {
  Eigen::Matrix<double, 6, 1> out;
  out.head<3>() = log_rotation(to.rotation * from.rotation.conjugate());
  out.tail<3>() = to.centre_m - from.centre_m;
  return out;
}

Eigen::Matrix<double, 6, 6> motion_metric(const PointSet& points, const CentredPose& pose) {
  const Eigen::Matrix3d r = pose.rotation.toRotationMatrix();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(r * points.scatter_m2 * r.transpose());
  const double least_m2 = std::pow(kThickness * points.radius_m, 2);
  const Eigen::Vector3d turning = (points.scatter_m2.trace() - axes.eigenvalues().array()).max(least_m2);
  Eigen::Matrix<double, 6, 6> out = Eigen::Matrix<double, 6, 6>::Zero();
  out.topLeftCorner<3, 3>() = axes.eigenvectors() * turning.asDiagonal() * axes.eigenvectors().transpose();
  out.bottomRightCorner<3, 3>().setIdentity();
  return out;
}

bool is_thin(const PointSet& points) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(points.scatter_m2, Eigen::EigenvaluesOnly);
  return points.scatter_m2.trace() - axes.eigenvalues()(2) < std::pow(kThickness * points.radius_m, 2);
}

double rms_between(const PointSet& points, const CentredPose& a, const CentredPose& b) {
  // The points are about their mean: the mean of |Rx + t|² is tr(R S R') + t².
  const Eigen::Matrix3d turned = a.rotation.toRotationMatrix() - b.rotation.toRotationMatrix();
  const double square = (turned * points.scatter_m2 * turned.transpose()).trace();
  return std::sqrt(std::max(0.0, square) + (a.centre_m - b.centre_m).squaredNorm());
}

}  // namespace asperity::registration
