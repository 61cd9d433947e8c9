#include "compare_solutions.h"

#include <algorithm>

namespace asperity::registration {

double compare_solutions(const SolutionContext& context, Matcher& fine, const std::vector<CentredPose>& poses,
                         ConvergedPose& best, RegistrationResult& out) {
  const auto& [surface, points, rules, options, config, noise_m, watch] = context;
  watch.begin(RegistrationPhase::kComparison);
  std::vector<ConvergedPose> solutions{best};
  for (const CentredPose& pose : poses) {
    watch.next_start();
    ConvergedPose other = fit_pose_fully(surface, points, rules, fine, pose, options, config);
    if (!other.fit.enough) continue;
    out.iterations += other.fit.iterations;
    const double same_m = std::max({5.0 * best.observability.determined_rms_m,
                                    2.0 * std::min(best.sigma_m, other.sigma_m), config.undetermined_m});
    const bool known = std::any_of(solutions.begin(), solutions.end(), [&](const ConvergedPose& s) {
      return rms_between(context.points, s.pose, other.pose) < same_m;
    });
    if (!known) solutions.push_back(std::move(other));
  }
  double least_m = best.sigma_m;
  for (const ConvergedPose& s : solutions) least_m = std::min(least_m, s.sigma_m);
  const double width_m = std::max(config.robust_sigmas * std::max(least_m, noise_m), 1e-9 * points.radius_m);
  std::stable_sort(solutions.begin(), solutions.end(), [&](const ConvergedPose& a, const ConvergedPose& b) {
    return robust_mean(a.distances_m, width_m) < robust_mean(b.distances_m, width_m);
  });
  best = solutions.front();
  if (solutions.size() < 2) return 0.0;
  const ConvergedPose& second = solutions[1];
  out.runner_up = RunnerUp{uncentred(second.pose, points), second.rms_m, rms_between(points, best.pose, second.pose),
                           best.pose.rotation.angularDistance(second.pose.rotation)};
  return excess_z(best.distances_m, second.distances_m, width_m);
}

}  // namespace asperity::registration
