#include "align/residual_sigma.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace asperity::studio {

namespace {

double sigma_along(const MeasuredPath& path, std::size_t point, const Eigen::Vector3d& n_world) {
  double variance_m2 = n_world.dot(path.slow_covariance_world_m2 * n_world);
  if (!(variance_m2 > 0.0)) variance_m2 = path.sigma_m * path.sigma_m;
  if (point < path.q_world_marker.size()) {
    const Eigen::Vector3d n_marker = path.q_world_marker[point].conjugate() * n_world;
    variance_m2 += n_marker.cwiseProduct(path.tip_sigma_m).squaredNorm();
  }
  return variance_m2 > 0.0 ? std::sqrt(variance_m2) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

ResidualSigma residual_sigma(const AlignScene& scene, const PathResiduals& residuals,
                             const std::vector<Pose>& T_mesh_world) {
  ResidualSigma out;
  std::vector<double> known_m;
  double square = 0.0;
  for (std::size_t i = 0; i < residuals.distance_m.size(); ++i) {
    const std::size_t k = scene.path[i];
    const Eigen::Vector3d n_world = T_mesh_world[k].rotation.conjugate() * residuals.normal_mesh[i];
    const double sigma_m = sigma_along(scene.scans.points[k].path, scene.point[i], n_world);
    out.sigma_m.push_back(static_cast<float>(sigma_m));
    if (!std::isfinite(sigma_m)) continue;
    known_m.push_back(sigma_m);
    square += std::pow(static_cast<double>(residuals.distance_m[i]) / sigma_m, 2);
  }
  if (known_m.empty()) return out;
  out.rms = std::sqrt(square / static_cast<double>(known_m.size()));
  const auto middle = known_m.begin() + static_cast<std::ptrdiff_t>(known_m.size() / 2);
  std::nth_element(known_m.begin(), middle, known_m.end());
  out.median_m = *middle;
  return out;
}

}  // namespace asperity::studio
