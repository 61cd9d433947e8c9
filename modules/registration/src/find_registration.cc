#include "asperity/registration/find_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "choose_points.h"
#include "coarse_fits.h"
#include "compare_solutions.h"
#include "match_rules.h"
#include "registration_verdict.h"

namespace asperity {

using namespace registration;  // NOLINT(google-build-using-namespace): the module's own

namespace {

// Rotation i of n, evenly spread (Alexa, Super-Fibonacci Spirals, 2022).
Eigen::Quaterniond spiral_rotation(int i, int n) {
  const double phi = std::numbers::sqrt2;
  const double psi = 1.533751168755204288118041;
  const double s = i + 0.5;
  const double r = std::sqrt(s / n);
  const double big_r = std::sqrt(1.0 - s / n);
  const double alpha = 2.0 * std::numbers::pi * s / phi;
  const double beta = 2.0 * std::numbers::pi * s / psi;
  return {big_r * std::cos(beta), r * std::sin(alpha), r * std::cos(alpha), big_r * std::sin(beta)};
}

struct SurfacePoint {
  Eigen::Vector3d p_m;
  Eigen::Vector3d n;
};

// Points spread evenly by area.
std::vector<SurfacePoint> spread_over(const TriangleMesh& mesh, int count) {
  std::vector<double> area(mesh.triangles.size());
  double total = 0.0;
  for (std::size_t t = 0; t < area.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    total += (mesh.vertices_m[b] - mesh.vertices_m[a]).cross(mesh.vertices_m[c] - mesh.vertices_m[a]).norm();
    area[t] = total;
  }
  std::vector<SurfacePoint> out;
  for (int i = 0; i < count; ++i) {
    // Triangles are listed by neighbourhood in most meshes: equal steps of the summed area spread over it.
    const double at = total * (i + 0.5) / count;
    const auto found = std::lower_bound(area.begin(), area.end(), at) - area.begin();
    const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(found, static_cast<std::ptrdiff_t>(area.size()) - 1))];
    const Eigen::Vector3d& p = mesh.vertices_m[a];
    out.push_back({(p + mesh.vertices_m[b] + mesh.vertices_m[c]) / 3.0,
                   (mesh.vertices_m[b] - p).cross(mesh.vertices_m[c] - p).normalized()});
  }
  return out;
}

struct Scored {
  double score_m = 0.0;
  CentredPose pose;
};

// The best poses of all rotations and positions by the mean distance of a few points.
std::vector<Scored> score_poses(const RegistrationSurface& surface, const PointSet& points, bool use_outward,
                                const SearchConfig& config, const Observer& observer) {
  const std::vector<std::uint32_t> few = choose_uniform(points, static_cast<std::size_t>(config.points));
  const std::vector<SurfacePoint> positions = spread_over(*surface.mesh, config.positions);
  const std::uint32_t anchor = few[few.size() / 2];
  const auto keep = static_cast<std::size_t>(config.coarse_runs);
  const auto worse = [](const Scored& a, const Scored& b) { return a.score_m < b.score_m; };
  std::vector<Scored> best;  // a heap, its worst first
  for (int i = 0; i < config.rotations; ++i) {
    observer.update("search", static_cast<double>(i) / config.rotations);
    const Eigen::Quaterniond rotation = spiral_rotation(i, config.rotations);
    const Eigen::Vector3d outward = rotation * points.outward[anchor];
    for (const SurfacePoint& at : positions) {
      if (use_outward && outward.dot(at.n) < 0.5) continue;  // beyond 60°
      const CentredPose pose{rotation, at.p_m - rotation * points.x_m[anchor]};
      const double limit_m = best.size() < keep ? std::numeric_limits<double>::infinity() : best.front().score_m;
      double sum_m = 0.0;
      for (const std::uint32_t k : few) {
        sum_m += surface.bvh->closest_point(pose * points.x_m[k]).distance_m;
        if (sum_m > limit_m) break;
      }
      if (!(sum_m < limit_m)) continue;
      if (best.size() == keep) {
        std::pop_heap(best.begin(), best.end(), worse);
        best.pop_back();
      }
      best.push_back({sum_m, pose});
      std::push_heap(best.begin(), best.end(), worse);
    }
  }
  std::sort_heap(best.begin(), best.end(), worse);
  return best;
}

}  // namespace

RegistrationResult find_registration(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                     const SearchConfig& given, const RegistrationObserver& observer) {
  check_surface(surface);
  // No guess is given, so that nothing is known of its error.
  SearchConfig config = given;
  config.registration.guess_sigma_m = RegistrationConfig{}.guess_sigma_m;
  config.registration.guess_sigma_deg = RegistrationConfig{}.guess_sigma_deg;
  if (static_cast<double>(config.rotations) * config.positions > 1e8) {
    throw Error(
        fmt::format("registration: {} rotations at {} positions are too many", config.rotations, config.positions));
  }
  IterationWatch watch(observer);
  RegistrationResult out;
  const PointSet points = gather_points(paths, out.problems);
  MatchRules rules = match_rules(config.registration);
  const bool use_outward = rules.facing_cos > -1.0 && std::none_of(points.outward.begin(), points.outward.end(),
                                                                   [](const auto& o) { return o.isZero(); });
  if (!use_outward) rules.facing_cos = -1.0;
  const std::vector<Scored> scored = score_poses(surface, points, use_outward, config, observer);
  if (scored.empty()) throw Error("registration: the probe's directions fit the mesh at no pose");

  FitOptions options;
  options.robust_sigmas = config.registration.robust_sigmas;
  options.isotropic = config.registration.isotropic;
  options.isotropic_decay = config.registration.isotropic_decay;
  options.max_iterations = 25;
  options.step_sigmas = 1.0;
  options.reference = scored.front().pose;
  options.watch = &watch;
  std::vector<CentredPose> starts;
  starts.reserve(scored.size());
  for (const Scored& s : scored) starts.push_back(s.pose);
  watch.begin(RegistrationPhase::kSearch);
  Matcher sparse(surface, points, choose_uniform(points, static_cast<std::size_t>(config.coarse_points)), rules);
  const std::vector<CoarseRun> runs =
      run_coarse_fits(sparse, points, starts, options, 0.0, static_cast<std::size_t>(config.refined), watch);
  if (runs.empty()) throw Error("registration: too few points of the path meet the mesh at any pose");

  options.isotropic = 0.0;
  options.step_sigmas = 0.5;
  options.max_iterations = config.registration.max_iterations;
  options.reference = runs.front().pose;
  const int limit = config.registration.max_points;
  Matcher fine(surface, points, choose_uniform(points, limit == 0 ? points.size() : static_cast<std::size_t>(limit)),
               rules);
  watch.begin(RegistrationPhase::kFit);
  ConvergedPose best = fit_pose_fully(surface, points, rules, fine, runs.front().pose, options, config.registration);
  out.iterations = best.fit.iterations;
  const double noise_m = std::hypot(path_noise_m(points, fine, best.pose), facet_sag_m(surface, fine));
  std::vector<CentredPose> others;
  for (std::size_t i = 1; i < runs.size(); ++i) others.push_back(runs[i].pose);
  const double z = compare_solutions({surface, points, rules, options, config.registration, noise_m, watch}, fine,
                                     others, best, out);
  write_registration_verdict({best, noise_m, TriedStarts::kEverywhere, z < kAmbiguousZ}, points, fine.size(),
                             config.registration, out);
  return out;
}

}  // namespace asperity
