#include "asperity/registration/find_symmetry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "find_unobservable_dofs.h"
#include "fit_pose.h"
#include "match_rules.h"
#include "surface_samples.h"

namespace asperity {

using namespace registration;  // NOLINT(google-build-using-namespace): the module's own

namespace {

constexpr int kSamples = 1000;

// The motion near `start` by which the points of a path lie on the mesh, if there is one.
std::optional<Pose> lay_on(const RegistrationSurface& surface, const std::vector<MeasuredPath>& path, const Pose& start,
                           double surface_error_m) {
  constexpr double kShare = 2e-4, kSags = 3.0;
  if (path[0].p_world_m.size() < 3) return {};
  Problems ignored;
  const PointSet points = gather_points(path, ignored);
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  Matcher matcher(surface, points, all, {});
  FitOptions options;
  options.isotropic = 0.3;
  options.max_iterations = 30;
  const Fit fit = fit_pose(matcher, points, centred(start, points), options);
  if (!fit.enough) return {};
  matcher.match(fit.pose);
  std::vector<double> away_m;
  for (const ClosestPoint& closest : matcher.closest()) away_m.push_back(closest.distance_m);
  const auto most = away_m.begin() + static_cast<std::ptrdiff_t>(995 * away_m.size() / 1000);
  std::nth_element(away_m.begin(), most, away_m.end());
  const double limit_m =
      std::max({kShare * points.radius_m, kSags * facet_sag_m(surface, matcher), 3.0 * surface_error_m});
  if (!(*most <= limit_m)) return {};
  return uncentred(fit.pose, points);
}

}  // namespace

std::optional<Pose> find_symmetry(const RegistrationSurface& surface, const Pose& motion, double surface_error_m) {
  check_surface(surface);
  std::vector<MeasuredPath> path(1);
  for (const SurfaceSample& sample : spread_over(*surface.mesh, kSamples)) path[0].p_world_m.push_back(sample.p_m);
  return lay_on(surface, path, motion, surface_error_m);
}

bool is_own_image(const RegistrationSurface& surface, const Eigen::Affine3d& reflection, double surface_error_m) {
  check_surface(surface);
  // The samples' image in the plane x = 0, and the motion from there to the reflection's.
  std::vector<MeasuredPath> path(1);
  const Eigen::Vector3d flip(-1.0, 1.0, 1.0);
  for (const SurfaceSample& sample : spread_over(*surface.mesh, kSamples)) {
    path[0].p_world_m.push_back(flip.cwiseProduct(sample.p_m));
  }
  const Eigen::Matrix3d turn = reflection.linear() * flip.asDiagonal();
  const Pose start{Eigen::Quaterniond(turn).normalized(), reflection.translation()};
  return lay_on(surface, path, start, surface_error_m).has_value();
}

}  // namespace asperity
