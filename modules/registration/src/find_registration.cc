#include "asperity/registration/find_registration.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "choose_points.h"
#include "coarse_fits.h"
#include "compare_solutions.h"
#include "match_rules.h"
#include "registration_verdict.h"
#include "search_poses.h"

namespace asperity {

using namespace registration;  // NOLINT(google-build-using-namespace): the module's own

namespace {

// What a search shares with the fits after it.
struct Search {
  PointSet points;
  MatchRules rules;
  FitOptions options;
  std::vector<CoarseRun> runs;  // the best first
};

Search search_everywhere(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                         const SearchConfig& config, IterationWatch& watch, const Observer& observer,
                         Problems& problems) {
  check_surface(surface);
  if (static_cast<double>(config.rotations) * config.positions > 1e8) {
    throw Error(
        fmt::format("registration: {} rotations at {} positions are too many", config.rotations, config.positions));
  }
  Search out;
  out.points = gather_points(paths, problems);
  out.rules = match_rules(config.registration);
  const bool use_outward =
      out.rules.facing_cos > -1.0 &&
      std::none_of(out.points.outward.begin(), out.points.outward.end(), [](const auto& o) { return o.isZero(); });
  if (!use_outward) out.rules.facing_cos = -1.0;
  const std::vector<SearchEnd> ends = search_poses(surface, out.points, use_outward, out.rules.facing_cos, config,
                                                   static_cast<std::size_t>(config.coarse_runs), observer);
  if (ends.empty()) throw Error("registration: the probe's directions fit the mesh at no pose");

  out.options.robust_sigmas = config.registration.robust_sigmas;
  out.options.isotropic = 0.0;
  out.options.isotropic_decay = config.registration.isotropic_decay;
  out.options.max_iterations = 15;
  out.options.step_sigmas = 1.0;
  out.options.reference = ends.front().pose;
  out.options.watch = &watch;
  std::vector<CentredPose> starts;
  starts.reserve(ends.size());
  for (const SearchEnd& end : ends) starts.push_back(end.pose);
  watch.begin(RegistrationPhase::kSearch);
  Matcher sparse(surface, out.points, choose_uniform(out.points, static_cast<std::size_t>(config.coarse_points)),
                 out.rules);
  out.runs =
      run_coarse_fits(sparse, out.points, starts, out.options, 0.0, static_cast<std::size_t>(config.distinct), watch);
  if (out.runs.empty()) throw Error("registration: too few points of the path meet the mesh at any pose");
  return out;
}

}  // namespace

std::vector<Pose> find_poses(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                             const SearchConfig& config, const RegistrationObserver& observer) {
  IterationWatch watch(observer);
  Problems ignored;
  const Search search = search_everywhere(paths, surface, config, watch, observer, ignored);
  std::vector<Pose> out;
  for (const CoarseRun& run : search.runs) out.push_back(uncentred(run.pose, search.points));
  return out;
}

RegistrationResult find_registration(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                     const SearchConfig& given, const RegistrationObserver& observer) {
  // No guess is given, so that nothing is known of its error.
  SearchConfig config = given;
  config.registration.guess_sigma_m = RegistrationConfig{}.guess_sigma_m;
  config.registration.guess_sigma_deg = RegistrationConfig{}.guess_sigma_deg;
  IterationWatch watch(observer);
  RegistrationResult out;
  Search search = search_everywhere(paths, surface, config, watch, observer, out.problems);
  const PointSet& points = search.points;
  FitOptions& options = search.options;
  const auto refined = std::min(search.runs.size(), static_cast<std::size_t>(config.refined));

  options.step_sigmas = 0.5;
  options.max_iterations = config.registration.max_iterations;
  options.reference = search.runs.front().pose;
  const int limit = config.registration.max_points;
  Matcher fine(surface, points, choose_uniform(points, limit == 0 ? points.size() : static_cast<std::size_t>(limit)),
               search.rules);
  watch.begin(RegistrationPhase::kFit);
  ConvergedPose best =
      fit_pose_fully(surface, points, search.rules, fine, search.runs.front().pose, options, config.registration);
  out.iterations = best.fit.iterations;
  const double noise_m = std::hypot(path_noise_m(points, fine, best.pose), facet_sag_m(surface, fine));
  std::vector<CentredPose> others;
  for (std::size_t i = 1; i < refined; ++i) others.push_back(search.runs[i].pose);
  const double z = compare_solutions({surface, points, search.rules, options, config.registration, noise_m, watch},
                                     fine, others, best, out);
  write_registration_verdict({best, noise_m, TriedStarts::kEverywhere, z < kAmbiguousZ}, points, fine.size(),
                             config.registration, out);
  return out;
}

}  // namespace asperity
