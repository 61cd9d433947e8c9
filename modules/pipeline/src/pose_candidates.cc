#include "asperity/pipeline/pose_candidates.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/registration/find_registration.h"
#include "asperity/registration/mesh_scale.h"
#include "asperity/registration/mirror_image.h"
#include "asperity/registration/pose_misfit.h"
#include "asperity/registration/pose_rivals.h"

namespace asperity {

namespace {

std::vector<MeasuredPath> paths_of(const ScanPoints& scans) {
  std::vector<MeasuredPath> out;
  for (const PathPoints& points : scans.points) out.push_back(points.path);
  return out;
}

}  // namespace

WeighConfig weigh_config(const ScanPoints& scans, const std::optional<Pose>& guess, const RefineConfig& refine) {
  WeighConfig out;
  out.slow_length_m = scans.in_sequence ? refine.slow_length_m : 0.0;
  out.guess_sigma_m = refine.guess_sigma_m;
  out.guess_sigma_rad = refine.guess_sigma_deg * std::numbers::pi / 180.0;
  // A guess whose error was stated is taken at its word.
  const RefineConfig usual;
  const bool stated = refine.guess_sigma_m < usual.guess_sigma_m || refine.guess_sigma_deg < usual.guess_sigma_deg;
  if (guess && stated) out.guess_lapse = 1e-6;
  return out;
}

PoseCandidates find_pose_candidates(const ScanPoints& scans, const RegistrationSurface& ready,
                                    const std::optional<Pose>& guess, std::span<const Pose> near,
                                    const RegisterConfig& config, const RegistrationObserver& observer) {
  const std::vector<MeasuredPath> paths = paths_of(scans);
  std::vector<Pose> candidates(near.begin(), near.end());
  PoseCandidates out;
  out.everywhere = !guess || config.search.rivals;
  if (out.everywhere) {
    std::vector<MeasuredPath> smooth = paths;
    if (scans.in_sequence) {
      for (MeasuredPath& path : smooth) path = smooth_path(path, config.points.smoothing_m);
    }
    const std::vector<Pose> anywhere = find_poses(smooth, ready, config.search, observer);
    candidates.insert(candidates.end(), anywhere.begin(), anywhere.end());
  }
  if (candidates.empty()) throw Error("registration: the search found no pose to begin from");
  out.found = weigh_poses(paths, ready, candidates, guess, weigh_config(scans, guess, config.refinement),
                          config.search.registration, observer);
  return out;
}

PoseRivals judge_candidate(const ScanPoints& scans, const RegistrationSurface& ready, const Pose& T_mesh_world,
                           const std::optional<Pose>& guess, const PoseCandidates& candidates,
                           const RegisterConfig& config) {
  const std::vector<MeasuredPath> paths = paths_of(scans);
  const WeighConfig weighing = weigh_config(scans, guess, config.refinement);
  const WeighedPose at = weigh_pose(paths, ready, T_mesh_world, guess, weighing, config.search.registration);
  RivalConfig rivals;
  rivals.surface_error_m = config.search.registration.surface_error_m;
  PoseRivals out = find_rivals(paths, ready, at, candidates.found, candidates.everywhere, rivals);
  // Another size may fit best from another of the valleys.
  std::vector<WeighedPose> starts{at};
  starts.insert(starts.end(), candidates.found.begin(), candidates.found.end());
  out.scale = measure_mesh_scale(paths, ready, starts, weighing, config.search.registration);
  out.mirror_log_odds = weigh_mirror_image(paths, ready, starts, weighing, config.search.registration);
  return out;
}

RegistrationResult judge_pose_by_hand(const ScanPoints& scans, const MeshSurface& surface, const Pose& T_mesh_world,
                                      const PoseCandidates& candidates, const RegisterConfig& config) {
  const RegistrationSurface ready = prepare_surface(surface.mesh, surface.bvh);
  const std::vector<MeasuredPath> paths = paths_of(scans);
  RegistrationResult out;
  out.T_mesh_world = T_mesh_world;
  out.converged = true;  // it is where it was put
  double square_m2 = 0.0, sum_m = 0.0;
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  ClosestPoint closest;
  for (const MeasuredPath& path : paths) {
    for (const Eigen::Vector3d& p_world_m : path.p_world_m) {
      const Eigen::Vector3d p_m = T_mesh_world * p_world_m;
      closest = closest.found() ? surface.bvh.closest_point(p_m, closest) : surface.bvh.closest_point(p_m);
      square_m2 += closest.distance_m * closest.distance_m;
      sum_m += closest.distance_m;
      middle_m += p_m;
      ++out.points;
    }
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, out.points));
  out.rms_m = std::sqrt(square_m2 / count);
  out.mean_m = sum_m / count;
  out.centre_mesh_m = middle_m / count;
  PoseMisfitConfig misfit;
  misfit.slow_length_m = config.refinement.slow_length_m;
  misfit.surface_error_m = config.search.registration.surface_error_m;
  out.misfit = measure_pose_misfit(paths, ready, {}, misfit, out);
  out.verdict = fmt::format("placed by hand. Residual {:.4f} mm RMS over {} points.", 1e3 * out.rms_m, out.points);
  state_rivals(judge_candidate(scans, ready, T_mesh_world, {}, candidates, config), out);
  return out;
}

}  // namespace asperity
