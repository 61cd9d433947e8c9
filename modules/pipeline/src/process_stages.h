#pragma once

#include <optional>
#include <string>

#include "asperity/base/progress.h"
#include "asperity/pipeline/force_limit.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"

namespace asperity {

// What a stage gives: its value, unless the data did not allow one, and what it reports of it.
template <class T>
struct Outcome {
  std::optional<T> value;
  Problems problems;
};

struct MeasuredProfile {
  Profile profile;
  std::vector<double> measured_texture_m;  // texture_m before the expected noise was taken out: surface and noise
  Coverage coverage;
  SpeedStatistics speed;
  TextureNoise noise;
  std::vector<RepeatedLine> lines;
  Profile as_measured;  // the profile before that, and its noise
  TextureNoise noise_as_measured;
  std::optional<ErodedProfile> surface;
};

// The outcomes of all stages between a recording and its texture. Without a base path or a profile those that need it
// have no value and nothing to say.
struct ProcessStages {
  Outcome<TrajectoryResult> trajectory;  // has a value
  std::optional<Recording> on_object;    // the recording relative to the object, if the trajectory is
  ForceLimit force_limit;                // found with the base
  Outcome<BasePathResult> base;
  Outcome<MeasuredProfile> profile;
  Outcome<RoughnessResult> roughness;
  Outcome<Periodicity> periodicity;
  Outcome<SurfaceSpectrum> spectrum;
  Outcome<Compliance> compliance;
  Outcome<StiffnessEstimate> stiffness;
  Outcome<FrictionEstimate> friction;
  Outcome<FourierFit> fit;
  Outcome<Accuracy> accuracy;
};

// The stages: pure functions of the recording, of the outcomes before them and of their own settings. What a usable
// recording may not allow, such as roughness of too short a profile, is in the outcome.
namespace stage {

// Relative to the object if there is one. Throws Error if the streams do not allow one, and Cancelled.
Outcome<TrajectoryResult> find_trajectory(const Recording& recording, const ProcessConfig& config,
                                          const ProcessMethod& method, const Observer& observer);
// The recording in the frame of the trajectory, for the stages behind it: of an object that moves `s.on_object`, made
// at the first call.
const Recording& in_frame(const Recording& recording, ProcessStages& s);
// Also makes the motion's force_N that along the path's normal, if the method has it so.
Outcome<BasePathResult> find_base_path(const Recording& recording, const ProcessConfig& config,
                                       const ProcessMethod& method, ProcessStages& before);
Outcome<MeasuredProfile> find_profile(const Recording& recording, const ProcessConfig& config,
                                      const ProcessMethod& method, const ProcessStages& before);
// With the periodicity: its elements, where noise hides the single ones.
Outcome<RoughnessResult> measure_roughness(const ProcessConfig& config, const ProcessStages& before);
Outcome<Periodicity> find_periodicity(const ProcessConfig& config, const ProcessStages& before);
Outcome<SurfaceSpectrum> measure_spectrum(const ProcessStages& before);
Outcome<Compliance> estimate_compliance(const Recording& recording, const ProcessConfig& config,
                                        const ProcessMethod& method, const ProcessStages& before);
Outcome<StiffnessEstimate> estimate_stiffness(const ProcessConfig& config, const ProcessStages& before);
Outcome<FrictionEstimate> estimate_friction(const ProcessConfig& config, const ProcessStages& before);
Outcome<FourierFit> fit_texture(const ProcessConfig& config, const ProcessStages& before);
// No value without a truth. One that does not fit says nothing against the measurement.
Outcome<Accuracy> compare_with_truth(const Recording& recording, const ProcessConfig& config,
                                     const ProcessMethod& method, const ProcessStages& before);

}  // namespace stage

// The heights that are expected, given the noise in them (apply_wiener_filter.h); what is left of that is the noise of
// the texture then. Without a density nothing changes.
void remove_noise(double bridge_m, Profile& profile, TextureNoise& noise);

// What follows a measured profile, of which `profile`, `noise`, `measured_texture_m` and `speed` are given.
void finish_profile(const Recording& recording, const ProcessConfig& config, MeasuredProfile& measured);

// The result with `measured_profile` changed and its noise: all that is made of the profile again, verdicts too. Its
// problems stay.
void measure_again(const Recording& recording, const ProcessConfig& config, MeasuredProfile measured,
                   ProcessResult& result);

Coverage measure_coverage(const Profile& profile);

// The texture of what was measured, `result.fit` among it.
Texture join_texture(const std::string& object, const ProcessMethod& method, const ProcessResult& result);

// The result of the stages' outcomes: their values, the texture made from them, and the verdict over all.
ProcessResult join_stages(const Recording& recording, const ProcessConfig& config, const ProcessMethod& method,
                          ProcessStages stages);

}  // namespace asperity
