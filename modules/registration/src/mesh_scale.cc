#include "asperity/registration/mesh_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/LU>

#include "match_rules.h"
#include "path_likelihood.h"

namespace asperity {

using namespace registration;  // NOLINT(google-build-using-namespace): the module's own

namespace {

constexpr std::size_t kMostStarts = 4;
constexpr int kRounds = 4, kSteps = 8;

// Standard error of log_size, all else that is unknown along with it, and the tip's share.
double log_size_sigma(const PointSet& points, const PathLikelihood::Scaled& at, const Eigen::Vector3d& tip_sigma_m,
                      double slow_ratio_spread) {
  Eigen::Matrix<double, 7, 7> precision = at.information.topLeftCorner<7, 7>();
  // Where the paths say nothing of a motion, it is still smaller than they are.
  precision(6, 6) += 1.0 / (PathLikelihood::kSizeSpread * PathLikelihood::kSizeSpread);
  precision.topLeftCorner<6, 6>() += motion_metric(points, at.at.pose) / std::pow(0.5 * points.radius_m, 2);
  const Eigen::Matrix<double, 7, 7> covariance = precision.inverse();
  // The slow error's size is uncertain itself: with log τ normal, E τ² is larger than the likeliest by exp(2 var log
  // τ).
  const double by_scale = 1.0 / std::pow(at.at.slow_ratio_sigma, 2) + 1.0 / std::pow(slow_ratio_spread, 2);
  const double widened = std::exp(2.0 / by_scale);
  const Eigen::Vector3d by_tip = -(covariance * at.information.topRightCorner<7, 3>()).row(6).transpose();
  return std::sqrt(widened * covariance(6, 6) + by_tip.cwiseProduct(tip_sigma_m).squaredNorm());
}

}  // namespace

MeshScale measure_mesh_scale(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                             std::span<const WeighedPose> starts, const WeighConfig& config,
                             const RegistrationConfig& registration) {
  check_surface(surface);
  Problems ignored;
  const PointSet points = gather_points(paths, ignored);
  PathLikelihood likelihood(paths, surface, points, weighing_rules(points, registration), config);
  MeshScale out;
  double as_it_is = std::numeric_limits<double>::infinity();
  std::optional<PathLikelihood::Scaled> best;
  for (std::size_t i = 0; i < std::min(kMostStarts, starts.size()); ++i) {
    const CentredPose start = centred(starts[i].T_mesh_world, points);
    as_it_is = std::min(as_it_is, likelihood.descend(start, kRounds, kSteps).cost);
    for (const double log_size : {0.0, -0.2, 0.2}) {
      if (i > 0 && log_size != 0.0) continue;
      const PathLikelihood::Scaled end = likelihood.descend_with_size(start, log_size, kRounds, kSteps);
      if (!best || end.at.restricted() < best->at.restricted()) best = end;
    }
  }
  if (!best) return out;
  as_it_is = std::min(as_it_is, likelihood.descend(best->at.pose, kRounds, kSteps).cost);
  Eigen::Vector3d tip_sigma_m = Eigen::Vector3d::Zero();
  for (const MeasuredPath& path : paths) {
    if (path.tip_sigma_m.allFinite()) tip_sigma_m = tip_sigma_m.cwiseMax(path.tip_sigma_m);
  }
  out.ratio = std::exp(best->log_size);
  out.sigma = log_size_sigma(points, *best, tip_sigma_m, config.slow_ratio_spread);
  out.gain = std::max(0.0, as_it_is - best->at.cost);
  return out;
}

}  // namespace asperity
