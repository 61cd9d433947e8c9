#include "asperity/registration/register_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "choose_points.h"
#include "other_starts.h"
#include "settle.h"
#include "verdict.h"

namespace asperity {

using namespace registration;

namespace {

// Relative to the pose's standard deviation: a step after which the fit of all points has ended, and a coarse one.
constexpr double kFineStep = 0.5;
constexpr double kCoarseStep = 0.5;
constexpr int kStartIterations = 15;
constexpr double kAmbiguous_z = 3.0;

MatchRules match_rules(const RegistrationConfig& config) {
  MatchRules out;
  out.normals = config.normals;
  out.facing_cos = config.facing_deg < 180.0 ? std::cos(config.facing_deg * std::numbers::pi / 180.0) : -1.0;
  out.max_distance_m = config.max_distance_m;
  return out;
}

// The probe's directions say nothing without any, and nothing useful where nearly all of them point into the mesh.
void check_facing(const RegistrationSurface& surface, const PointSet& points, const CentredPose& guess,
                  std::span<const std::uint32_t> chosen, MatchRules& rules, Problems& problems) {
  std::size_t given = 0;
  std::size_t against = 0;
  for (const std::uint32_t i : chosen) {
    if (points.outward[i].isZero()) continue;
    const ClosestPoint q = surface.bvh->closest_point(guess * points.x_m[i]);
    if (!q.found()) continue;
    ++given;
    const Eigen::Vector3d normal = surface.facets[q.triangle].normal.cast<double>();
    against += (guess.rotation * points.outward[i]).dot(normal) < rules.facing_cos ? 1 : 0;
  }
  if (given == 0) {
    rules.facing_cos = -1.0;
  } else if (10 * against > 9 * given) {
    rules.facing_cos = -1.0;
    problems.push_back({"outward_into_mesh",
                        "the probe's directions point into the mesh: its triangles may be turned inside out, or the "
                        "guess is wrong; the directions were not used",
                        against});
  }
}

bool is_doubtful(const Settled& best, double noise_m, std::size_t points, const StartsConfig& config) {
  return best.sigma_m > config.doubtful_ratio * noise_m ||
         static_cast<double>(best.outliers) > config.doubtful_outliers * static_cast<double>(points);
}

}  // namespace

RegistrationResult register_path(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                 const Pose& guess, const RegistrationConfig& config) {
  if (surface.mesh == nullptr || surface.bvh == nullptr || surface.facets.size() != surface.mesh->triangles.size()) {
    throw Error("registration: the surface was not prepared from its mesh");
  }
  if (!guess.rotation.coeffs().allFinite() || !(guess.rotation.norm() > 0.0) || !guess.translation_m.allFinite()) {
    throw Error("registration: the guess is not a finite pose");
  }
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
  coarse_options.reference = start;
  coarse_options.step_sigmas = kCoarseStep;
  Matcher coarse(surface, points, few, rules);
  const Fit first = fit_pose(coarse, points, start, coarse_options);

  FitOptions fine_options = coarse_options;
  fine_options.isotropic = 0.0;
  fine_options.step_sigmas = kFineStep;
  const std::size_t limit = config.max_points == 0 ? points.size() : static_cast<std::size_t>(config.max_points);
  Matcher fine(surface, points, choose_uniform(points, limit), rules);
  Settled best = settle(surface, points, rules, fine, first.pose, fine_options, config);
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
        starts_about(start, config.starts.count, config.starts.radius_m, config.starts.turn_deg);
    starts.insert(starts.begin(), best.pose);
    const std::vector<CoarseRun> runs = run_coarsely(sparse, points, starts, quick, config.robust_sigmas * noise_m,
                                                     static_cast<std::size_t>(config.starts.refined) + 1);
    std::vector<Settled> solutions{best};
    for (const CoarseRun& run : runs) {
      Settled other = settle(surface, points, rules, fine, run.pose, fine_options, config);
      if (!other.fit.enough) continue;
      out.iterations += other.fit.iterations;
      const double same_m = std::max(
          {5.0 * best.freedom.determined_rms_m, 2.0 * std::min(best.sigma_m, other.sigma_m), config.undetermined_m});
      const bool known = std::any_of(solutions.begin(), solutions.end(), [&](const Settled& s) {
        return rms_between(points, s.pose, other.pose) < same_m;
      });
      if (!known) solutions.push_back(std::move(other));
    }
    double width_m = config.robust_sigmas * noise_m;
    double least_m = solutions.front().sigma_m;
    for (const Settled& s : solutions) least_m = std::min(least_m, s.sigma_m);
    width_m = std::max({width_m, config.robust_sigmas * least_m, 1e-9 * points.radius_m});
    std::stable_sort(solutions.begin(), solutions.end(), [&](const Settled& a, const Settled& b) {
      return robust_mean(a.distances_m, width_m) < robust_mean(b.distances_m, width_m);
    });
    best = solutions.front();
    if (solutions.size() > 1) {
      const Settled& second = solutions[1];
      runner_up_z = excess_z(best.distances_m, second.distances_m, width_m);
      out.runner_up =
          RunnerUp{uncentred(second.pose, points), second.rms_m, rms_between(points, best.pose, second.pose),
                   best.pose.rotation.angularDistance(second.pose.rotation)};
    }
  }
  write_verdict({best, noise_m, tried, runner_up_z < kAmbiguous_z}, points, fine.size(), config, out);
  return out;
}

}  // namespace asperity
