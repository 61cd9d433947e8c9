#include "asperity/registration/placement_likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "asperity/base/error.h"

namespace asperity {

namespace {

// Logarithm of the volume of all poses, rad³ m³.
double log_pose_space(const RegistrationSurface& surface) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Eigen::Vector3d& p_m : surface.mesh->vertices_m) {
    low = low.cwiseMin(p_m);
    high = high.cwiseMax(p_m);
  }
  // A flat mesh has poses to either side as well.
  const Eigen::Vector3d size_m = (high - low).cwiseMax(0.1 * (high - low).maxCoeff());
  return std::log(8.0 * std::numbers::pi * std::numbers::pi * size_m.prod());
}

}  // namespace

PlacementFit best_placement(std::span<const WeighedPose> found, const RegistrationSurface& surface) {
  if (found.empty()) throw Error("registration: the search found no pose to begin from");
  const auto log_mass = [](const WeighedPose& pose) { return pose.log_volume - 0.5 * pose.fit; };
  const auto best = std::max_element(found.begin(), found.end(), [&](const WeighedPose& a, const WeighedPose& b) {
    return log_mass(a) < log_mass(b);
  });
  return {best->T_mesh_world, log_mass(*best) - log_pose_space(surface)};
}

PlacementFit fit_placement(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                           std::span<const Pose> starts, const WeighConfig& config,
                           const RegistrationConfig& registration) {
  return best_placement(weigh_poses(paths, surface, starts, std::nullopt, config, registration), surface);
}

}  // namespace asperity
