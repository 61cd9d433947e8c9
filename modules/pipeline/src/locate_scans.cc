#include "asperity/pipeline/locate_scans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/pipeline/find_placements.h"
#include "asperity/pipeline/pose_candidates.h"
#include "asperity/registration/estimate_drift.h"
#include "asperity/registration/pose_error.h"
#include "asperity/registration/pose_misfit.h"
#include "asperity/registration/pose_rivals.h"
#include "asperity/registration/refine_placements.h"
#include "asperity/registration/refine_registration.h"
#include "asperity/registration/register_path.h"

namespace asperity {

namespace {

struct PoseStep {
  Eigen::Vector3d turn, shift_m;
};

// Turns and shifts within balls of the given radii, on an additive sequence (Roberts 2018) of six numbers.
std::vector<PoseStep> spread_steps(int count, double shift_m, double rotation_rad) {
  constexpr double kRoot = 1.1347241384015194;  // x⁷ = x + 1
  std::vector<PoseStep> out;
  for (int i = 1; out.size() < static_cast<std::size_t>(count) && i < 100 * count; ++i) {
    std::array<double, 6> u{};
    double power = 1.0;
    for (double& value : u) {
      power /= kRoot;
      value = 2.0 * std::fmod(0.5 + power * i, 1.0) - 1.0;
    }
    const Eigen::Vector3d a(u[0], u[1], u[2]), b(u[3], u[4], u[5]);
    if (a.norm() <= 1.0 && b.norm() <= 1.0) out.push_back({rotation_rad * a, shift_m * b});
  }
  return out;
}

// Where fits end that begin at other guesses, evenly spread about the given one.
std::vector<Pose> other_fits(const std::vector<MeasuredPath>& paths, const RegistrationSurface& surface,
                             const std::optional<Pose>& guess, RegistrationConfig config, const RefineConfig& refine,
                             const RegistrationObserver& observer) {
  std::vector<Pose> out;
  if (!guess || !refine.enabled) return out;
  config.starts.when = OtherStarts::kNever;
  config.max_points = config.coarse_points;
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (const MeasuredPath& path : paths) {
    for (const Eigen::Vector3d& p_m : path.p_world_m) middle_m += p_m;
    count += path.p_world_m.size();
  }
  middle_m = *guess * Eigen::Vector3d(middle_m / static_cast<double>(std::max<std::size_t>(1, count)));
  RegistrationObserver inner = observer;
  if (observer.iterated) {
    inner.iterated = [&observer, &out](RegistrationIteration iteration) {
      iteration.phase = RegistrationPhase::kGuesses;
      iteration.start = static_cast<int>(out.size());
      observer.iterated(iteration);
    };
  }
  for (const PoseStep& step :
       spread_steps(refine.other_starts, refine.other_shift_m, refine.other_turn_deg * std::numbers::pi / 180.0)) {
    observer.update("other guesses", static_cast<double>(out.size()) / std::max(1, refine.other_starts));
    const Eigen::Quaterniond turn = exp_rotation(step.turn);
    const Pose about{turn * guess->rotation, turn * (guess->translation_m - middle_m) + middle_m + step.shift_m};
    out.push_back(register_path(paths, surface, about, config, inner).T_mesh_world);
  }
  return out;
}

// The user has said how well the guess is known.
bool is_stated(const RegistrationConfig& search, const RefineConfig& refine) {
  const RegistrationConfig usual_search;
  const RefineConfig usual_refine;
  return search.guess_sigma_m < usual_search.guess_sigma_m || search.guess_sigma_deg < usual_search.guess_sigma_deg ||
         refine.guess_sigma_m < usual_refine.guess_sigma_m || refine.guess_sigma_deg < usual_refine.guess_sigma_deg;
}

bool is_near(const Pose& guess, const Pose& pose, const Eigen::Vector3d& centre_mesh_m, const RefineConfig& config) {
  constexpr double kSigmas = 3.0;
  const Pose motion = pose * guess.inverse();
  const Eigen::Vector3d before_m = motion.inverse() * centre_mesh_m;
  return (centre_mesh_m - before_m).norm() < kSigmas * config.guess_sigma_m &&
         rotation_between_rad(guess, pose) < kSigmas * config.guess_sigma_deg * std::numbers::pi / 180.0;
}

// The points of some of the scans.
ScanPoints points_of(const ScanPoints& scans, const std::vector<std::size_t>& members) {
  ScanPoints out;
  out.in_sequence = scans.in_sequence;
  for (const std::size_t i : members) out.points.push_back(scans.points[i]);
  return out;
}

PoseMisfitConfig misfit_config(const RegisterConfig& config) {
  // A guess that is stated to be better known for the refinement than that takes for granted is held to it.
  const RefineConfig usual;
  const RegistrationConfig& search = config.search.registration;
  const auto stated = [](double by_search, double by_refinement, double usually) {
    return by_refinement < usually ? std::min(by_search, by_refinement) : by_search;
  };
  return {config.refinement.slow_length_m, search.surface_error_m,
          stated(search.guess_sigma_m, config.refinement.guess_sigma_m, usual.guess_sigma_m),
          stated(search.guess_sigma_deg, config.refinement.guess_sigma_deg, usual.guess_sigma_deg) * std::numbers::pi /
              180.0,
          is_stated(search, config.refinement)};
}

// The settings of the search, with the errors that last along a scan.
RegisterConfig search_config(const ScanPoints& scans, const RegisterConfig& config) {
  RegisterConfig out = config;
  double& error_length_m = out.search.registration.error_length_m;
  if (scans.in_sequence && error_length_m == 0.0) error_length_m = config.refinement.slow_length_m;
  return out;
}

// Paths without stated errors get those that their heights show at the pose: all of them the largest.
std::optional<AssumedDrift> assume_errors(const RegistrationSurface& ready, const Pose& T_mesh_world, bool in_sequence,
                                          const RegisterConfig& config, std::vector<MeasuredPath>& paths) {
  std::optional<AssumedDrift> out;
  WeighConfig weighing;
  weighing.slow_length_m = config.refinement.slow_length_m;
  for (const MeasuredPath& path : paths) {
    if (path.slow_covariance_world_m2.trace() > 0.0) continue;
    if (!out) out.emplace();
    if (!in_sequence) continue;
    const AssumedDrift drift = estimate_drift(path, ready, T_mesh_world, weighing, config.search.registration);
    out->sigma_m = std::max(out->sigma_m, drift.sigma_m);
    out->length_m = std::max(out->length_m, drift.length_m);
  }
  if (!out || !(out->sigma_m > 0.0)) return out;
  for (MeasuredPath& path : paths) {
    if (path.slow_covariance_world_m2.trace() > 0.0) continue;
    path.slow_covariance_world_m2 = out->sigma_m * out->sigma_m * Eigen::Matrix3d::Identity();
    path.sigma_m = out->sigma_m;
  }
  return out;
}

// The settings with the length that was found with assumed errors.
RegisterConfig with_assumed(RegisterConfig config, const std::optional<AssumedDrift>& assumed) {
  if (assumed && assumed->length_m > 0.0) config.refinement.slow_length_m = assumed->length_m;
  return config;
}

// Scans of one placement, from a guess or from anywhere; `known` is a pose that fits as well as any that was found,
// `candidates` gets all poses that were compared, and paths without stated errors those that they show.
RefinedRegistration locate_together(ScanPoints& scans, const std::vector<std::size_t>& members,
                                    const MeshSurface& surface, const RegistrationSurface& ready,
                                    const std::optional<Pose>& guess, const std::optional<Pose>& known,
                                    const RegisterConfig& config, const RegistrationObserver& observer,
                                    PoseCandidates& candidates) {
  observer.update("registration", 0.0);
  std::vector<MeasuredPath> paths, smooth;
  for (const std::size_t i : members) {
    const MeasuredPath& path = scans.points[i].path;
    paths.push_back(path);
    smooth.push_back(scans.in_sequence ? smooth_path(path, config.points.smoothing_m) : path);
  }
  const RegisterConfig searched = search_config(scans, config);
  const RegistrationConfig& search = searched.search.registration;
  RefinedRegistration out;
  const ProcessMethod& method = ProcessMethods::get(config.process.method);
  if (method.register_paths) {
    if (!guess) throw Error("registration by this method begins from a pose near the right one: give a guess of it");
    out.registration = method.register_paths(config.process, paths, surface, *guess);
    out.slow_error_world_m.resize(members.size());
    // The baseline's method knows no error of its guess.
    out.registration.misfit = measure_pose_misfit(paths, ready, {}, misfit_config(config), out.registration);
    return out;
  }
  // All poses at which the paths may lie: those near the guess and those anywhere.
  std::vector<Pose> near;
  if (guess) {
    out.registration = register_path(smooth, ready, *guess, search, observer);
    near = other_fits(smooth, ready, guess, search, config.refinement, observer);
    near.push_back(out.registration.T_mesh_world);
    if (out.registration.runner_up) near.push_back(out.registration.runner_up->T_mesh_world);
  }
  if (known) near.push_back(*known);
  candidates = find_pose_candidates(points_of(scans, members), ready, guess, near, searched, observer);
  const bool keeps_guess = guess && search.starts.when == OtherStarts::kNever && config.refinement.other_starts == 0;
  if (!keeps_guess) {
    RegistrationConfig local = search;
    local.starts.when = OtherStarts::kNever;
    out.registration = register_path(smooth, ready, candidates.found.front().T_mesh_world, local, observer);
  }
  out.registration.assumed = assume_errors(ready, out.registration.T_mesh_world, scans.in_sequence, searched, paths);
  // A guess that the paths contradict has no say in the refinement.
  const std::optional<Pose> believed =
      guess && is_near(*guess, out.registration.T_mesh_world, out.registration.centre_mesh_m, config.refinement)
          ? guess
          : std::nullopt;
  // Scans have errors that last along the path; points without a sequence have none that is known.
  out.slow_error_world_m.resize(members.size());
  if (!scans.in_sequence) return out;
  observer.update("refinement", 0.0);
  for (std::size_t i = 0; i < members.size(); ++i)
    scans.points[members[i]].path.slow_covariance_world_m2 = paths[i].slow_covariance_world_m2;
  return refine_registration(paths, surface, out.registration, believed, {},
                             with_assumed(config, out.registration.assumed).refinement, observer);
}

// The scans of each placement, its guess, and a pose that is known to fit.
struct Groups {
  std::vector<std::vector<std::size_t>> scans;
  std::vector<std::optional<Pose>> guesses, known;
};

bool fits_guess(const Pose& pose, const Pose& guess, const std::vector<std::size_t>& members, const ScanPoints& scans,
                const PoseMisfitConfig& misfit) {
  constexpr double kSigmas = 4.0;
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const std::size_t i : members) {
    for (const Eigen::Vector3d& p_m : scans.points[i].path.p_world_m) {
      middle_m += p_m;
      count += 1.0;
    }
  }
  middle_m /= std::max(1.0, count);
  return (pose * middle_m - guess * middle_m).norm() <= kSigmas * misfit.guess_sigma_m &&
         rotation_between_rad(pose, guess) <= kSigmas * misfit.guess_sigma_rad;
}

Groups group_scans(const ScanPoints& scans, const RegistrationSurface& ready, const std::optional<Pose>& guess,
                   const RegisterConfig& config, const RegistrationObserver& observer) {
  const std::size_t count = scans.points.size();
  Groups out;
  const bool finds = scans.placement.empty() && config.placement.mode == PlacementMode::kAuto && count > 1 &&
                     scans.in_sequence && config.refinement.enabled &&
                     !ProcessMethods::get(config.process.method).register_paths;
  if (!finds) {
    std::vector<std::size_t> stated = scans.placement;
    for (std::size_t i = 0; stated.size() < count; ++i)
      stated.push_back(config.placement.mode == PlacementMode::kEach ? i : 0);
    out.scans = group_placements(stated);
    out.guesses.assign(out.scans.size(), guess);
    out.known.resize(out.scans.size());
    return out;
  }
  FoundPlacements found = find_placements(scans, ready, guess, config, observer);
  out.scans = std::move(found.groups);
  for (std::size_t k = 0; k < out.scans.size(); ++k) {
    // A guess is that of the placements that it fits; one placement is as if it had been stated.
    const bool guessed = guess && (out.scans.size() == 1 ||
                                   fits_guess(found.poses[k], *guess, out.scans[k], scans, misfit_config(config)));
    out.guesses.push_back(guessed ? guess : std::nullopt);
    out.known.emplace_back(found.poses[k]);
  }
  return out;
}

void refine_together(const ScanPoints& scans, const MeshSurface& surface,
                     const std::vector<std::optional<Pose>>& guesses, const RegisterConfig& config,
                     const RegistrationObserver& observer, LocatedScans& out) {
  std::vector<MeasuredPath> paths;
  for (const PathPoints& points : scans.points) paths.push_back(points.path);
  std::vector<RegistrationResult> starts;
  for (const Placement& placement : out.placements) starts.push_back(placement.registration);
  observer.update("placements together", 0.0);
  RefinedPlacements refined =
      refine_placements(paths, out.placement_of, surface, starts, guesses, config.refinement, observer);
  for (std::size_t k = 0; k < out.placements.size(); ++k)
    out.placements[k].registration = std::move(refined.registrations[k]);
  out.slow_error_world_m = std::move(refined.slow_error_world_m);
  out.tip_shift_m = std::move(refined.tip_shift_m);
  out.tip_sigma_m = std::move(refined.tip_sigma_m);
  out.rms_m = std::move(refined.rms_m);
  out.bulge_share = refined.bulge_share;
  out.bulge_sigma = refined.bulge_sigma;
  out.crossings = refined.crossings;
  out.matched_shifts = refined.shifts;
}

void measure_misfit(const ScanPoints& scans, const RegistrationSurface& ready, const std::optional<Pose>& guess,
                    const RegisterConfig& config, const LocatedScans& located, Placement& placement) {
  if (!scans.in_sequence) return;
  std::vector<MeasuredPath> paths;
  for (const std::size_t i : placement.scans) {
    MeasuredPath path = scans.points[i].path;
    for (std::size_t k = 0; k < path.p_world_m.size() && k < path.q_world_marker.size(); ++k) {
      if (!located.tip_shift_m.empty()) path.p_world_m[k] += path.q_world_marker[k] * located.tip_shift_m[i];
    }
    paths.push_back(std::move(path));
  }
  placement.registration.misfit =
      measure_pose_misfit(paths, ready, guess, misfit_config(config), placement.registration);
}

// The comparison of poses knows nothing of errors that were assumed after it.
void raise_sigma(const ScanPoints& scans, const RegistrationResult& result, PoseRivals& rivals) {
  std::vector<Eigen::Vector3d> p_mesh_m;
  for (const PathPoints& points : scans.points) {
    for (const Eigen::Vector3d& p_m : points.path.p_world_m) {
      if (p_m.allFinite()) p_mesh_m.push_back(result.T_mesh_world * p_m);
    }
  }
  const PoseError error = pose_error(result, result.T_mesh_world, p_mesh_m);
  rivals.sigma_m = std::max(rivals.sigma_m, error.sigma_m);
  rivals.sigma_rad = std::max(rivals.sigma_rad, error.sigma_rad);
}

}  // namespace

LocatedScans locate_scans(const ScanPoints& scans, const MeshSurface& surface, const std::optional<Pose>& guess,
                          const RegisterConfig& config, const RegistrationObserver& observer) {
  const std::size_t count = scans.points.size();
  if (!scans.placement.empty() && scans.placement.size() != count)
    throw Error("registration: the placement is stated of some scans only");
  const RegistrationSurface ready = prepare_surface(surface.mesh, surface.bvh);
  const Groups groups = group_scans(scans, ready, guess, config, observer);
  LocatedScans out;
  out.placement_of.resize(count);
  out.slow_error_world_m.resize(count);
  out.rms_m.assign(count, std::numeric_limits<double>::quiet_NaN());
  std::vector<std::optional<Pose>> believed;
  ScanPoints known;  // with errors for all
  known.points = scans.points;
  known.in_sequence = scans.in_sequence;
  for (std::size_t k = 0; k < groups.scans.size(); ++k) {
    PoseCandidates candidates;
    RefinedRegistration located = locate_together(known, groups.scans[k], surface, ready, groups.guesses[k],
                                                  groups.known[k], config, observer, candidates);
    out.candidates.push_back(std::move(candidates));
    const RegistrationResult& found = located.registration;
    const std::optional<Pose>& guessed = groups.guesses[k];
    believed.push_back(guessed && is_near(*guessed, found.T_mesh_world, found.centre_mesh_m, config.refinement)
                           ? guessed
                           : std::nullopt);
    for (std::size_t i = 0; i < groups.scans[k].size(); ++i) {
      const std::size_t scan = groups.scans[k][i];
      out.placement_of[scan] = k;
      out.slow_error_world_m[scan] = std::move(located.slow_error_world_m[i]);
      out.rms_m[scan] = located.registration.rms_m;
    }
    out.placements.push_back({std::move(located.registration), groups.scans[k], {}});
  }
  if (ProcessMethods::get(config.process.method).register_paths) return out;
  std::optional<AssumedDrift> longest;
  for (const Placement& placement : out.placements) {
    const std::optional<AssumedDrift>& assumed = placement.registration.assumed;
    if (assumed && (!longest || assumed->length_m > longest->length_m)) longest = assumed;
  }
  const RegisterConfig last = with_assumed(config, longest);
  if (scans.in_sequence) refine_together(known, surface, believed, last, observer, out);
  const RegisterConfig searched = search_config(scans, last);
  for (std::size_t k = 0; k < out.placements.size(); ++k) {
    Placement& placement = out.placements[k];
    measure_misfit(known, ready, groups.guesses[k], last, out, placement);
    const Pose& pose = placement.registration.T_mesh_world;
    PoseRivals rivals =
        judge_candidate(points_of(scans, placement.scans), ready, pose, groups.guesses[k], out.candidates[k], searched);
    if (placement.registration.assumed && !rivals.symmetric_motion)
      raise_sigma(points_of(known, placement.scans), placement.registration, rivals);
    state_rivals(rivals, placement.registration);
  }
  return out;
}

}  // namespace asperity
