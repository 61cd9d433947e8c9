#include "asperity/registration/mirror_image.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "asperity/registration/find_symmetry.h"

namespace asperity {

namespace {

constexpr std::size_t kMostPoses = 6;
constexpr double kImageNegligible = -12.0;  // log odds below which nothing is asked of the image

struct Axes {
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns, least extent first
};

std::optional<Axes> principal_axes(std::span<const MeasuredPath> paths) {
  Axes out;
  double count = 0.0;
  for (const MeasuredPath& path : paths) {
    for (const Eigen::Vector3d& p_m : path.p_world_m) {
      if (!p_m.allFinite()) continue;
      out.mean_m += p_m;
      count += 1.0;
    }
  }
  if (count < 3.0) return std::nullopt;
  out.mean_m /= count;
  Eigen::Matrix3d spread_m2 = Eigen::Matrix3d::Zero();
  for (const MeasuredPath& path : paths) {
    for (const Eigen::Vector3d& p_m : path.p_world_m) {
      if (p_m.allFinite()) spread_m2 += (p_m - out.mean_m) * (p_m - out.mean_m).transpose();
    }
  }
  out.axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread_m2).eigenvectors();
  return out;
}

// In the plane across the least extent.
Eigen::Affine3d reflection_about(const Axes& about) {
  const Eigen::Vector3d normal = about.axes.col(0);
  Eigen::Affine3d out = Eigen::Affine3d::Identity();
  out.linear() -= 2.0 * normal * normal.transpose();
  out.translation() = about.mean_m - out.linear() * about.mean_m;
  return out;
}

Eigen::Affine3d affine(const Pose& pose) { return Eigen::Translation3d(pose.translation_m) * pose.rotation; }

std::vector<MeasuredPath> reflected(std::span<const MeasuredPath> paths, const Eigen::Affine3d& reflection) {
  const Eigen::Matrix3d S = reflection.linear();
  std::vector<MeasuredPath> out(paths.begin(), paths.end());
  for (MeasuredPath& path : out) {
    for (Eigen::Vector3d& p_m : path.p_world_m) p_m = reflection * p_m;
    for (Eigen::Vector3d& outward : path.outward_world) outward = S * outward;
    path.slow_covariance_world_m2 = S * path.slow_covariance_world_m2 * S;
    path.q_world_marker.clear();  // a reflected marker is no marker
  }
  return out;
}

}  // namespace

double weigh_mirror_image(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                          std::span<const WeighedPose> at, const WeighConfig& config,
                          const RegistrationConfig& registration) {
  const std::optional<Axes> about = principal_axes(paths);
  if (at.empty() || !about) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::Affine3d reflection = reflection_about(*about);
  const std::vector<MeasuredPath> image = reflected(paths, reflection);
  std::vector<Pose> starts;
  for (const WeighedPose& pose : at.first(std::min(kMostPoses, at.size()))) {
    starts.push_back(pose.T_mesh_world);
    for (int k = 1; k < 3; ++k) {
      const Eigen::Quaterniond half = exp_rotation(std::numbers::pi * about->axes.col(k));
      starts.push_back(pose.T_mesh_world * Pose{half, about->mean_m - half * about->mean_m});
    }
  }
  // The poses in question without their guess: it knows nothing of the hand.
  const std::vector<WeighedPose> best = weigh_poses(image, surface, starts, {}, config, registration);
  const std::vector<Pose> first{at.front().T_mesh_world};
  const std::vector<WeighedPose> mesh = weigh_poses(paths, surface, first, {}, config, registration);
  const double log_odds = best.front().log_mass - mesh.front().log_mass;
  const Eigen::Affine3d onto_itself =
      affine(best.front().T_mesh_world) * reflection * affine(mesh.front().T_mesh_world).inverse();
  const bool own = log_odds > kImageNegligible && is_own_image(surface, onto_itself, registration.surface_error_m);
  return own ? std::numeric_limits<double>::quiet_NaN() : log_odds;
}

}  // namespace asperity
