#include "align/align_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "asperity/pipeline/locate_scans.h"
#include "asperity/pipeline/scan_evidence.h"
#include "asperity/verdict/verdict_json.h"
#include "json_pose.h"

namespace asperity::studio {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Standard deviations of the middle's place and of the turn, from the covariance.
std::string certainty_of(const RegistrationResult& result) {
  const double shift_m = std::sqrt(result.covariance.bottomRightCorner<3, 3>().trace());
  const double turn_rad = std::sqrt(result.covariance.topLeftCorner<3, 3>().trace());
  if (!std::isfinite(shift_m) || !std::isfinite(turn_rad)) return "The uncertainty of the pose cannot be computed.";
  if (!result.undetermined.empty()) {
    double sigma_m = 0.0;
    for (const UndeterminedMotion& motion : result.undetermined) sigma_m = std::max(sigma_m, motion.sigma_m);
    return std::isfinite(sigma_m)
               ? fmt::format("Along the undetermined motion the path is known to {:.3g} mm (standard deviation).",
                             1e3 * sigma_m)
               : std::string("Along the undetermined motion only the guess states the position of the path.");
  }
  return fmt::format("The path's centre is known to {:.3g} mm and its rotation to {:.2g}° (standard deviations).",
                     1e3 * shift_m, turn_rad / kDegree);
}

}  // namespace

RegisterConfig run_config(const AlignChoice& choice, bool near) {
  RegisterConfig out = config_of(choice);
  out.placement.mode = PlacementMode::kSame;  // the page has one pose
  if (near) {
    out.search.registration.starts.when = OtherStarts::kNever;
    out.refinement.other_starts = 0;
  }
  return out;
}

AlignRun run_align(std::uint64_t number, const std::shared_ptr<const AlignScene>& scene, const AlignChoice& choice,
                   const std::optional<Pose>& guess, const RegistrationObserver& observer) {
  AlignRun out;
  out.number = number;
  out.scene = scene;
  LocatedScans located = locate_scans(scene->scans, scene->surface, guess, run_config(choice, false), observer);
  out.result = located.placements.front().registration;
  for (std::size_t i = 0; i < located.placement_of.size(); ++i) {
    const std::size_t k = located.placement_of[i];
    const RegistrationResult& registration = located.placements[k].registration;
    out.scans.push_back({i < choice.paths.size() ? choice.paths[i] : "", k + 1, registration.T_mesh_world,
                         registration.rms_m, std::string(verdict_word(judge_pose(registration, guess.has_value())))});
  }
  if (located.candidates.size() == 1) out.candidates = std::move(located.candidates.front());
  out.how = {guess, false, out.result.T_mesh_world};
  out.certainty = certainty_of(out.result);
  return out;
}

Json judge_by_hand(const AlignScene& scene, const AlignChoice& choice, const Pose& pose,
                   const std::optional<PoseCandidates>& candidates, const RegistrationObserver& observer) {
  const RegisterConfig config = config_of(choice);
  const PoseCandidates compared =
      candidates ? *candidates
                 : find_pose_candidates(scene.scans, prepare_surface(scene.surface.mesh, scene.surface.bvh),
                                        std::nullopt, {}, config, observer);
  const RegistrationResult result = judge_pose_by_hand(scene.scans, scene.surface, pose, compared, config);
  const Verdicts verdicts = judge_pose(result, true);
  Json out;
  out["T_mesh_world"] = json_of_pose(pose);
  out["rms_m"] = number_or_null(result.rms_m);
  out["trustworthy"] = is_trustworthy(verdicts);
  out["verdict"] = result.verdict;
  out["verdicts"] = verdicts_json(verdicts);
  return out;
}

Json json_of_run(const AlignRun& run) {
  const RegistrationResult& result = run.result;
  Json out;
  out["run"] = run.number;
  out["guess"] = run.how.guess ? json_of_pose(*run.how.guess) : Json();
  out["T_mesh_world"] = json_of_pose(result.T_mesh_world);
  out["rms_m"] = number_or_null(result.rms_m);
  out["mean_m"] = number_or_null(result.mean_m);
  out["points"] = result.points;
  out["outliers"] = result.outliers;
  out["iterations"] = result.iterations;
  out["converged"] = result.converged;
  const Verdicts verdicts = judge_pose(result, run.how.guess.has_value());
  out["trustworthy"] = is_trustworthy(verdicts);
  out["ambiguous"] = result.ambiguous;
  out["verdict"] = result.verdict;
  out["verdicts"] = verdicts_json(verdicts);
  out["certainty"] = run.certainty;
  out["undetermined"] = Json::array();
  for (const UndeterminedMotion& motion : result.undetermined) {
    Json each;
    each["description"] = motion.description;
    each["sigma_m"] = number_or_null(motion.sigma_m);
    out["undetermined"].push_back(std::move(each));
  }
  out["runner_up"] = nullptr;
  if (result.runner_up) {
    Json other;
    other["T_mesh_world"] = json_of_pose(result.runner_up->T_mesh_world);
    other["rms_m"] = number_or_null(result.runner_up->rms_m);
    other["distance_m"] = number_or_null(result.runner_up->distance_m);
    other["turn_deg"] = number_or_null(result.runner_up->rotation_rad / kDegree);
    out["runner_up"] = std::move(other);
  }
  out["scans"] = Json::array();
  for (const AlignedScan& scan : run.scans) {
    Json each;
    each["name"] = scan.name;
    each["placement"] = scan.placement;
    each["T_mesh_world"] = json_of_pose(scan.T_mesh_world);
    each["rms_m"] = number_or_null(scan.rms_m);
    each["verdict"] = scan.verdict;
    out["scans"].push_back(std::move(each));
  }
  out["problems"] = Json::array();
  for (const Problem& problem : result.problems) out["problems"].push_back(problem.message);
  return out;
}

}  // namespace asperity::studio
