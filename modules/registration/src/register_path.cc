#include "asperity/registration/register_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "choose_points.h"
#include "coarse_fits.h"
#include "compare_solutions.h"
#include "match_rules.h"
#include "registration_verdict.h"

namespace asperity {

using namespace registration;  // NOLINT(google-build-using-namespace): the module's own

namespace {

// Relative to the pose's standard deviation: a step after which the fit of all points has ended, and a coarse one.
constexpr double kFineStep = 1.0;
constexpr double kCoarseStep = 0.5;
constexpr int kStartIterations = 15;

bool is_doubtful(const ConvergedPose& best, double noise_m, std::size_t points, const StartsConfig& config) {
  return best.sigma_m > config.doubtful_ratio * noise_m ||
         static_cast<double>(best.outliers) > config.doubtful_outliers * static_cast<double>(points);
}

// How many of `used` points, evenly spread over the paths, share one error.
double points_alike(const PointSet& points, std::size_t used, double error_length_m) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points.path[i] == points.path[i - 1]) length_m += (points.x_m[i] - points.x_m[i - 1]).norm();
  }
  if (!(error_length_m > 0.0) || !(length_m > 0.0)) return 1.0;
  const auto count = static_cast<double>(used);
  return std::clamp(error_length_m / length_m * count, 1.0, count);
}

}  // namespace

RegistrationResult register_path(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                 const Pose& guess, const RegistrationConfig& config,
                                 const RegistrationObserver& observer) {
  check_surface(surface);
  if (!guess.rotation.coeffs().allFinite() || !(guess.rotation.norm() > 0.0) || !guess.translation_m.allFinite()) {
    throw Error("registration: the guess is not a finite pose");
  }
  IterationWatch watch(observer);
  RegistrationResult out;
  const PointSet points = gather_points(paths, out.problems);
  const CentredPose start = centred(guess, points);
  const std::vector<std::uint32_t> few = choose_points(surface, points, start, config.sampling, config.coarse_points);
  MatchRules rules = match_rules(config);
  check_facing(surface, points, start, few, rules, out.problems);

  FitOptions coarse_options;
  coarse_options.robust_sigmas = config.robust_sigmas;
  coarse_options.isotropic = config.isotropic;
  coarse_options.isotropic_decay = config.isotropic_decay;
  coarse_options.max_iterations = config.max_iterations;
  coarse_options.guess_sigma_m = config.guess_sigma_m;
  coarse_options.guess_sigma_rad = config.guess_sigma_deg * std::numbers::pi / 180.0;
  coarse_options.alike = points_alike(points, few.size(), config.error_length_m);
  coarse_options.reference = start;
  coarse_options.step_sigmas = kCoarseStep;
  coarse_options.watch = &watch;
  Matcher coarse(surface, points, few, rules);
  watch.begin(RegistrationPhase::kAnnealing);
  const Fit first = fit_pose(coarse, points, start, coarse_options);

  const std::size_t limit =
      config.max_points == 0 ? points.size() : std::min(points.size(), static_cast<std::size_t>(config.max_points));
  FitOptions fine_options = coarse_options;
  fine_options.isotropic = 0.0;
  fine_options.step_sigmas = kFineStep;
  fine_options.known_scale_m = first.scale_m;
  fine_options.alike = points_alike(points, limit, config.error_length_m);
  Matcher fine(surface, points, choose_uniform(points, limit), rules);
  watch.begin(RegistrationPhase::kFit);
  ConvergedPose best = fit_pose_fully(surface, points, rules, fine, first.pose, fine_options, config);
  out.iterations = first.iterations + best.fit.iterations;

  const double noise_m = std::hypot(path_noise_m(points, fine, best.pose), facet_sag_m(surface, fine));
  const bool tried =
      config.starts.count > 0 &&
      (config.starts.when == OtherStarts::kAlways ||
       (config.starts.when == OtherStarts::kDoubtful && is_doubtful(best, noise_m, fine.size(), config.starts)));
  double runner_up_z = 0.0;
  if (tried) {
    FitOptions quick = coarse_options;
    quick.max_iterations = kStartIterations;
    quick.step_sigmas = 1.0;
    Matcher sparse(surface, points, choose_uniform(points, static_cast<std::size_t>(config.starts.points)), rules);
    std::vector<CentredPose> starts =
        sample_starts_around(start, config.starts.count, config.starts.radius_m, config.starts.turn_deg);
    starts.insert(starts.begin(), best.pose);
    watch.begin(RegistrationPhase::kRestarts);
    const std::vector<CoarseRun> runs = run_coarse_fits(sparse, points, starts, quick, config.robust_sigmas * noise_m,
                                                        static_cast<std::size_t>(config.starts.refined) + 1, watch);
    std::vector<CentredPose> poses;
    poses.reserve(runs.size());
    for (const CoarseRun& run : runs) poses.push_back(run.pose);
    fine_options.known_scale_m = 0.0;
    runner_up_z =
        compare_solutions({surface, points, rules, fine_options, config, noise_m, watch}, fine, poses, best, out);
  }
  write_registration_verdict(
      {best, noise_m, tried ? TriedStarts::kAboutGuess : TriedStarts::kNone, runner_up_z < kAmbiguousZ}, points,
      fine.size(), config, out);
  return out;
}

}  // namespace asperity
