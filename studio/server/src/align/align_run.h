#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "align/align_scene.h"
#include "align/iteration_log.h"
#include "asperity/pipeline/pose_candidates.h"
#include "asperity/registration/registration_result.h"

namespace asperity::studio {

// Where a scan is placed by a registration: scans of one placement share their pose.
struct AlignedScan {
  std::string name;
  std::size_t placement = 1;  // from 1
  Pose T_mesh_world;
  double rms_m = 0.0;   // of its placement
  std::string verdict;  // "valid", "limited" or "invalid", of its pose
};

// One registration of a scene, from a guess or from anywhere.
struct AlignRun {
  std::uint64_t number = 0;
  std::shared_ptr<const AlignScene> scene;
  AlignChoice::Registered how;  // its T_mesh_world is where it ended
  RegistrationResult result;    // of the first placement
  std::vector<AlignedScan> scans;
  PoseCandidates candidates;  // what the pose was compared with; empty where there are several placements
  std::string certainty;      // how well the pose is known, in words
};

// The choice's settings; where the guess is to be kept to, without other places about it.
RegisterConfig run_config(const AlignChoice& choice, bool near);

// Registers, as register_scans does. Throws as locate_scans does.
AlignRun run_align(std::uint64_t number, const std::shared_ptr<const AlignScene>& scene, const AlignChoice& choice,
                   const std::optional<Pose>& guess, const RegistrationObserver& observer);

// The verdict on a pose that was set by hand, compared with the result of a run or, without one, with what is found
// now. {"T_mesh_world","rms_m","trustworthy","verdict","verdicts"}.
Json judge_by_hand(const AlignScene& scene, const AlignChoice& choice, const Pose& pose,
                   const std::optional<PoseCandidates>& candidates, const RegistrationObserver& observer);

// {"run","guess","T_mesh_world","rms_m","mean_m","points","outliers","iterations","converged","trustworthy",
// "ambiguous","verdict","verdicts","certainty","undetermined":[{"description","sigma_m"}],"runner_up","problems",
// "scans":[{"name","placement","T_mesh_world","rms_m","verdict"}]}; what is not finite is null.
Json json_of_run(const AlignRun& run);

}  // namespace asperity::studio
