#include "asperity/registration/register_path.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "choose_points.h"
#include "fit_pose.h"

namespace asperity {

using namespace registration;

RegistrationResult register_path(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                 const Pose& guess, const RegistrationConfig& config) {
  RegistrationResult out;
  const PointSet points = gather_points(paths, out.problems);
  MatchRules rules{config.normals, config.facing_deg < 180.0 ? std::cos(config.facing_deg * std::numbers::pi / 180.0) : -1.0, config.max_distance_m};
  rules.facing_cos = -1.0;
  FitOptions options;
  options.robust_sigmas = config.robust_sigmas;
  options.isotropic = config.isotropic;
  options.isotropic_decay = config.isotropic_decay;
  options.max_iterations = config.max_iterations;
  options.guess_sigma_m = config.guess_sigma_m;
  options.reference = centred(guess, points);
  options.step_sigmas = 0.5;
  Matcher coarse(surface, points, choose_uniform(points, config.coarse_points), rules);
  Fit fit = fit_pose(coarse, points, options.reference, options);
  out.iterations = fit.iterations;
  Matcher fine(surface, points, choose_uniform(points, config.max_points), rules);
  options.isotropic = 0;
  options.step_sigmas = 0.1;
  fit = fit_pose(fine, points, fit.pose, options);
  out.iterations = out.iterations*1000+fit.iterations;
  out.T_mesh_world = uncentred(fit.pose, points);
  out.stopped_by = fit.stopped_by;
  return out;
}

}  // namespace asperity
