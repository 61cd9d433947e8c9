#include "asperity/pipeline/locate_scans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/pipeline/pose_candidates.h"
#include "asperity/registration/pose_misfit.h"
#include "asperity/registration/pose_rivals.h"
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

// Scans of one placement; `candidates` gets all poses that were compared.
RefinedRegistration locate_together(const ScanPoints& scans, const std::vector<std::size_t>& members,
                                    const MeshSurface& surface, const RegistrationSurface& ready,
                                    const std::optional<Pose>& guess, const RegisterConfig& config,
                                    const RegistrationObserver& observer, PoseCandidates& candidates) {
  observer.update("registration", 0.0);
  std::vector<MeasuredPath> paths, smooth;
  for (const std::size_t i : members) {
    const MeasuredPath& path = scans.points[i].path;
    paths.push_back(path);
    smooth.push_back(scans.in_sequence ? smooth_path(path, config.points.smoothing_m) : path);
  }
  SearchConfig search = config.search;
  if (scans.in_sequence && search.registration.error_length_m == 0.0) {
    search.registration.error_length_m = config.refinement.slow_length_m;
  }
  // A guess that is stated to be better known for the refinement than that takes for granted is held to it.
  const RefineConfig usual;
  const auto stated = [](double by_search, double by_refinement, double usually) {
    return by_refinement < usually ? std::min(by_search, by_refinement) : by_search;
  };
  const PoseMisfitConfig misfit{
      config.refinement.slow_length_m, search.registration.surface_error_m,
      stated(search.registration.guess_sigma_m, config.refinement.guess_sigma_m, usual.guess_sigma_m),
      stated(search.registration.guess_sigma_deg, config.refinement.guess_sigma_deg, usual.guess_sigma_deg) *
          std::numbers::pi / 180.0,
      is_stated(search.registration, config.refinement)};
  RefinedRegistration out;
  const ProcessMethod& method = ProcessMethods::get(config.process.method);
  if (method.register_paths) {
    if (!guess)
      throw Error(
          "registration by this method begins from a pose near the right one: give a guess (--guess, --align or "
          "--picks)");
    out.registration = method.register_paths(config.process, paths, surface, *guess);
    out.slow_error_world_m.resize(members.size());
    // The baseline's method knows no error of its guess.
    out.registration.misfit = measure_pose_misfit(paths, ready, {}, misfit, out.registration);
    return out;
  }
  // All poses at which the paths may lie: those near the guess and those anywhere.
  std::vector<Pose> near;
  if (guess) {
    out.registration = register_path(smooth, ready, *guess, search.registration, observer);
    near = other_fits(smooth, ready, guess, search.registration, config.refinement, observer);
    near.push_back(out.registration.T_mesh_world);
    if (out.registration.runner_up) near.push_back(out.registration.runner_up->T_mesh_world);
  }
  RegisterConfig searched = config;
  searched.search = search;
  const ScanPoints together = points_of(scans, members);
  candidates = find_pose_candidates(together, surface, guess, near, searched, observer);
  const bool keeps_guess =
      guess && search.registration.starts.when == OtherStarts::kNever && config.refinement.other_starts == 0;
  if (!keeps_guess) {
    RegistrationConfig local = search.registration;
    local.starts.when = OtherStarts::kNever;
    out.registration = register_path(smooth, ready, candidates.found.front().T_mesh_world, local, observer);
  }
  // A guess that the paths contradict has no say in the refinement.
  const std::optional<Pose> believed =
      guess && is_near(*guess, out.registration.T_mesh_world, out.registration.centre_mesh_m, config.refinement)
          ? guess
          : std::nullopt;
  // Scans have errors that last along the path; points without a sequence have none that is known.
  out.slow_error_world_m.resize(members.size());
  if (scans.in_sequence) {
    observer.update("refinement", 0.0);
    RefinedRegistration refined =
        refine_registration(paths, surface, out.registration, believed, {}, config.refinement, observer);
    out = std::move(refined);
    out.registration.misfit = measure_pose_misfit(paths, ready, guess, misfit, out.registration);
  }
  state_rivals(judge_candidate(together, surface, out.registration.T_mesh_world, guess, candidates, searched),
               out.registration);
  return out;
}

}  // namespace

LocatedScans locate_scans(const ScanPoints& scans, const MeshSurface& surface, const std::optional<Pose>& guess,
                          const RegisterConfig& config, const RegistrationObserver& observer) {
  const std::size_t count = scans.points.size();
  std::vector<std::size_t> stated = scans.placement;
  if (stated.empty()) {
    for (std::size_t i = 0; i < count; ++i) stated.push_back(config.placement.mode == PlacementMode::kEach ? i : 0);
  }
  if (stated.size() != count) throw Error("registration: the placement is stated of some scans only");
  const RegistrationSurface ready = prepare_surface(surface.mesh, surface.bvh);
  LocatedScans out;
  out.placement_of.resize(count);
  out.slow_error_world_m.resize(count);
  for (std::vector<std::size_t>& members : group_placements(stated)) {
    PoseCandidates candidates;
    RefinedRegistration located = locate_together(scans, members, surface, ready, guess, config, observer, candidates);
    out.candidates.push_back(std::move(candidates));
    for (std::size_t k = 0; k < members.size(); ++k) {
      out.placement_of[members[k]] = out.placements.size();
      out.slow_error_world_m[members[k]] = std::move(located.slow_error_world_m[k]);
    }
    out.placements.push_back({std::move(located.registration), std::move(members), {}});
  }
  return out;
}

}  // namespace asperity
