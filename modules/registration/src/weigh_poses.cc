#include "asperity/registration/weigh_poses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>

#include "match_rules.h"
#include "path_likelihood.h"

namespace asperity {

using namespace registration;  // NOLINT(google-build-using-namespace): the module's own

namespace {

// −2 log of the guess's prior at a pose.
double guess_cost(const PointSet& points, const std::optional<Pose>& guess, const CentredPose& pose,
                  const WeighConfig& config) {
  if (!guess) return 0.0;
  const Vector6 off = motion_between(centred(*guess, points), pose);
  const double square = off.head<3>().squaredNorm() / std::pow(config.guess_sigma_rad, 2) +
                        off.tail<3>().squaredNorm() / std::pow(config.guess_sigma_m, 2);
  return -2.0 * std::log(config.guess_lapse + (1.0 - config.guess_lapse) * std::exp(-0.5 * square));
}

WeighedPose weighed(const PathLikelihood::Evaluation& at, const PointSet& points, const std::optional<Pose>& guess,
                    const WeighConfig& config) {
  WeighedPose out;
  out.T_mesh_world = uncentred(at.pose, points);
  out.fit = at.cost;
  out.slow_ratio = at.scales.slow_ratio;
  out.noise_m = *std::max_element(at.scales.noise_m.begin(), at.scales.noise_m.end());
  out.outlying = at.outlying;
  out.information = at.information;
  out.slow_ratio_sigma = at.slow_ratio_sigma;
  // Where the path says nothing, a valley is as wide as the path.
  const Matrix6 metric = motion_metric(points, at.pose) / std::pow(0.5 * points.radius_m, 2);
  const double log_volume = 0.5 * (metric.ldlt().vectorD().array().log().sum() - at.log_precision);
  out.log_volume = 3.0 * std::log(2.0 * std::numbers::pi) - 0.5 * at.log_precision;
  out.log_mass = -0.5 * (at.cost + guess_cost(points, guess, at.pose, config)) + log_volume;
  return out;
}

// Whether two poses are the same one, within what the first is known to.
bool same_place(const PointSet& points, const PathLikelihood::Evaluation& a, const PathLikelihood::Evaluation& b) {
  constexpr double kSame2 = 2.0;
  const Vector6 apart = motion_between(a.pose, b.pose);
  return apart.dot(a.information * apart) < kSame2 || rms_between(points, a.pose, b.pose) < 1e-3 * points.radius_m;
}

}  // namespace

std::vector<WeighedPose> weigh_poses(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                     std::span<const Pose> candidates, const std::optional<Pose>& guess,
                                     const WeighConfig& config, const RegistrationConfig& registration,
                                     const RegistrationObserver& observer) {
  check_surface(surface);
  Problems ignored;
  const PointSet points = gather_points(paths, ignored);
  PathLikelihood likelihood(paths, surface, points, weighing_rules(points, registration), config);
  std::vector<PathLikelihood::Evaluation> first;
  double least = std::numeric_limits<double>::infinity();
  for (const Pose& candidate : candidates) {
    observer.update("comparison", 0.5 * static_cast<double>(first.size()) / static_cast<double>(candidates.size()));
    first.push_back(likelihood.descend(centred(candidate, points), 1, 3));
    least = std::min(least, first.back().restricted());
  }
  std::stable_sort(first.begin(), first.end(),
                   [](const auto& a, const auto& b) { return a.restricted() < b.restricted(); });
  // What is this much less likely after the first steps does not catch up.
  constexpr double kHopeless = 60.0;
  constexpr std::size_t kLeastEnds = 11;  // so many the best is compared with all the same (chance_of_gap.h)
  std::vector<PathLikelihood::Evaluation> ends;
  for (const auto& begun : first) {
    if (begun.restricted() > least + kHopeless && ends.size() >= kLeastEnds) break;
    if (std::any_of(ends.begin(), ends.end(), [&](const auto& end) { return same_place(points, end, begun); }))
      continue;
    observer.update("comparison", 0.5);
    const PathLikelihood::Evaluation end = likelihood.descend(begun.pose, 3, 6);
    const auto known =
        std::find_if(ends.begin(), ends.end(), [&](const auto& other) { return same_place(points, other, end); });
    if (known == ends.end()) {
      ends.push_back(end);
    } else if (end.restricted() < known->restricted()) {
      *known = end;
    }
  }
  std::vector<WeighedPose> out;
  for (const auto& end : ends) out.push_back(weighed(end, points, guess, config));
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.log_mass > b.log_mass; });
  return out;
}

WeighedPose weigh_pose(std::span<const MeasuredPath> paths, const RegistrationSurface& surface, const Pose& pose,
                       const std::optional<Pose>& guess, const WeighConfig& config,
                       const RegistrationConfig& registration) {
  check_surface(surface);
  Problems ignored;
  const PointSet points = gather_points(paths, ignored);
  PathLikelihood likelihood(paths, surface, points, weighing_rules(points, registration), config);
  return weighed(likelihood.evaluate(centred(pose, points)), points, guess, config);
}

}  // namespace asperity
