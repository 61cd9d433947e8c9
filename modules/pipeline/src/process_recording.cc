#include "asperity/pipeline/process_recording.h"

#include <cmath>
#include <string>

#include "asperity/pipeline/config_json.h"
#include "asperity/pipeline/process_motion.h"
#include "process_stages.h"
#include "run_stages.h"

namespace asperity {

namespace {

void distrust(ProcessResult& result, const std::string& why) {
  result.trustworthy = false;
  result.verdict += (result.verdict.empty() ? "" : "; ") + why;
}

// Takes a stage's notes into the result; true if it has its part.
bool take(ProcessResult& result, const StageNotes& notes) {
  result.problems.insert(result.problems.end(), notes.problems.begin(), notes.problems.end());
  for (const std::string& doubt : notes.doubts) distrust(result, doubt);
  return !notes.failed;
}

// What a stage's outcome depends on, as text.
template <class Config>
std::string settings(Config config) {
  return to_toml(list_fields("", config), false);
}

std::string trajectory_settings(const ProcessConfig& config) {
  const bool fused = config.method == Method::kFused;
  return fused ? "fused\n" + settings(config.fused) : "thesis\n" + settings(config.thesis.trajectory);
}

std::string profile_settings(const ProcessConfig& config) {
  const bool fused = config.method == Method::kFused;
  return fused ? "fused\n" + settings(config.profile) : "thesis\n" + settings(config.thesis.profile);
}

void judge_coverage(ProcessResult& result, const ProcessConfig& config) {
  if (result.coverage.covered < config.min_coverage) {
    const int percent = static_cast<int>(std::lround(100.0 * result.coverage.covered));
    distrust(result, "only " + std::to_string(percent) + " % of the profile has heights");
  }
}

// The path without the fine motion, and its normals (seed §1.4, §6.2; errata 23 and 24); the height along it and its
// texture (seed §5.1, §5.2).
bool find_surface(const ProcessConfig& config, const FindBase& find_base, KeptStages& kept, ProcessResult& result,
                  const Observer& observer) {
  observer.update("base path", 0.7);
  const bool has_base = take(result, kept.run(Stage::kBasePath, {Stage::kTrajectory}, settings(config.base),
                                              [&] { return stage::find_base_path(find_base, result); }));
  if (!has_base) return false;
  observer.update("profile", 0.8);
  return take(result, kept.run(Stage::kProfile, {Stage::kTrajectory, Stage::kBasePath}, profile_settings(config),
                               [&] { return stage::find_profile(config, result); }));
}

void measure_surface(const Recording& recording, const ProcessConfig& config, KeptStages& kept, ProcessResult& result,
                     const Observer& observer) {
  observer.update("roughness", 0.85);
  take(result, kept.run(Stage::kRoughness, {Stage::kProfile}, settings(config.roughness),
                        [&] { return stage::measure_roughness(config.roughness, result); }));
  take(result, kept.run(Stage::kPeriodicity, {Stage::kProfile}, settings(config.periodicity),
                        [&] { return stage::find_periodicity(config.periodicity, result); }));

  // How it yields (seed §5.3, erratum 15).
  observer.update("compliance", 0.9);
  take(result, kept.run(Stage::kCompliance, {Stage::kTrajectory, Stage::kBasePath}, settings(config.compliance),
                        [&] { return stage::estimate_compliance(recording, config, result); }));
  take(result, kept.run(Stage::kStiffness, {Stage::kTrajectory, Stage::kBasePath}, settings(config.stiffness),
                        [&] { return stage::estimate_stiffness(config.stiffness, result); }));

  // What a hand is to feel of it (seed §6.5, erratum 18).
  observer.update("texture", 0.95);
  result.texture.reset();
  if (take(result, kept.run(Stage::kTexture, {Stage::kProfile}, settings(config.texture),
                            [&] { return stage::fit_texture(config.texture, result); }))) {
    result.texture = stage::join_texture(recording, config, result);
  }
}

// Without a base path or a profile there is nothing to measure.
void clear_surface(KeptStages& kept, ProcessResult& result) {
  for (const Stage stage : {Stage::kProfile, Stage::kRoughness, Stage::kPeriodicity, Stage::kCompliance,
                            Stage::kStiffness, Stage::kTexture}) {
    kept.drop(stage);
  }
  result.profile = {};
  result.coverage = {};
  result.speed = {};
  result.roughness.reset();
  result.periodicity = {};
  result.compliance = {};
  result.stiffness = {};
  result.fit.reset();
  result.texture.reset();
}

}  // namespace

void run_motion_stages(const Recording& recording, const ProcessConfig& config, KeptStages& kept, ProcessResult& result,
                       const Observer& observer) {
  ProcessConfig resolved = config;
  result.config_json = config_json(list_fields("", resolved));
  result.problems = recording.problems;
  result.trustworthy = true;
  result.verdict.clear();

  // Where the tip was (seed §4.1 to §4.3).
  observer.update("trajectory", 0.0);
  take(result, kept.run(Stage::kTrajectory, {}, trajectory_settings(config),
                        [&] { return stage::find_trajectory(recording, config, result, observer); }));
}

void run_surface_stages(const Recording& recording, const ProcessConfig& config, const FindBase& find_base,
                        KeptStages& kept, ProcessResult& result, const Observer& observer) {
  const bool trustworthy = result.trustworthy;
  if (find_surface(config, find_base, kept, result, observer)) {
    measure_surface(recording, config, kept, result, observer);
    judge_coverage(result, config);
  } else {
    clear_surface(kept, result);
  }
  // What fails where nothing was felt is said, not held against the motion.
  if (!stage::has_force(recording.probe) && trustworthy) {
    result.trustworthy = true;
    result.verdict.clear();
  }
  if (recording.truth) {
    take(result, kept.run(Stage::kAccuracy, {Stage::kTrajectory, Stage::kBasePath, Stage::kProfile},
                          settings(config.comparison),
                          [&] { return stage::compare_with_truth(recording, config.comparison, result); }));
  }
  observer.update("texture", 1.0);
}

FindBase base_path_finder(const Recording& recording, const ProcessConfig& config) {
  return [&](const TipMotion& motion) {
    return find_base_path(motion, recording.calibration.tip_in_marker_m, config.base);
  };
}

ProcessResult estimate_motion(const Recording& recording, const ProcessConfig& config, const Observer& observer) {
  ProcessResult result;
  KeptStages nothing;
  run_motion_stages(recording, config, nothing, result, observer);
  return result;
}

void measure_along(const Recording& recording, const ProcessConfig& config, const FindBase& find_base,
                   ProcessResult& result, const Observer& observer) {
  KeptStages nothing;
  run_surface_stages(recording, config, find_base, nothing, result, observer);
}

ProcessResult process_recording(const Recording& recording, const ProcessConfig& config, const Observer& observer) {
  ProcessResult result = estimate_motion(recording, config, observer);
  measure_along(recording, config, base_path_finder(recording, config), result, observer);
  return result;
}

}  // namespace asperity
