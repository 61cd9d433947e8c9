#include "asperity/registration/estimate_drift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "match_rules.h"
#include "path_likelihood.h"

namespace asperity {

using namespace registration;  // NOLINT(google-build-using-namespace): the module's own

AssumedDrift estimate_drift(const MeasuredPath& path, const RegistrationSurface& surface, const Pose& T_mesh_world,
                            const WeighConfig& config, const RegistrationConfig& registration) {
  check_surface(surface);
  Problems ignored;
  MeasuredPath unstated = path;
  unstated.slow_covariance_world_m2.setZero();
  const std::span<const MeasuredPath> paths(&unstated, 1);
  const PointSet points = gather_points(paths, ignored);
  const MatchRules rules = weighing_rules(points, registration);
  constexpr double kStep = 1.4, kSpread = 0.7;  // of the length: a factor, and a standard deviation of the logarithm
  constexpr int kSteps = 5;                     // to either side
  // A drift of a smoother or a hand is smooth over millimetres, which the model's is not: with short blocks its size
  // would be that of a process which is as smooth, too small over centimetres.
  constexpr double kLongestBlock_m = 8e-3, kBlocks = 20.0;
  const double length_m = points.s_m.back() - points.s_m.front();
  AssumedDrift out;
  double least = std::numeric_limits<double>::infinity();
  for (int k = -kSteps; k <= kSteps; ++k) {
    WeighConfig at_length = config;
    at_length.slow_length_m = config.slow_length_m * std::pow(kStep, k);
    at_length.memory_m = std::max(config.memory_m, std::min(kLongestBlock_m, length_m / kBlocks));
    PathLikelihood likelihood(paths, surface, points, rules, at_length);
    const PathLikelihood::Evaluation at = likelihood.evaluate(centred(T_mesh_world, points));
    const double cost = at.restricted() + std::pow(k * std::log(kStep) / kSpread, 2);
    if (!(cost < least)) continue;
    least = cost;
    // Of a log-normal size, E τ² = (likeliest τ)² exp(2 var log τ).
    const double precision = 1.0 / std::pow(at.slow_ratio_sigma, 2) + 1.0 / std::pow(kUnstatedSpread, 2);
    out.sigma_m = at.scales.slow_ratio * kUnstatedDrift * points.radius_m * std::exp(1.0 / precision);
    out.length_m = at_length.slow_length_m;
  }
  return out;
}

}  // namespace asperity
