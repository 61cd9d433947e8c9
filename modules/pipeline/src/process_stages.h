#pragma once

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/process_motion.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"
#include "kept_stages.h"

// The stages between a recording and its texture. Each makes its own part of the result from the recording and from the
// parts that the ones before it have made, and knows no other settings than those it is given. What a usable recording
// may not allow, such as roughness of too short a profile, leaves the part empty and is in the notes.
namespace asperity::stage {

// A force sensor that never changes is none: whether the tip touched is then not known.
bool has_force(const ProbeStream& probe);

// trajectory. Throws Error if the streams do not allow one, and Cancelled.
StageNotes find_trajectory(const Recording& recording, const ProcessConfig& config, ProcessResult& result,
                           const Observer& observer);

// base.
StageNotes find_base_path(const FindBase& find_base, ProcessResult& result);

// profile, coverage, speed.
StageNotes find_profile(const ProcessConfig& config, ProcessResult& result);

StageNotes measure_roughness(const RoughnessConfig& config, ProcessResult& result);
StageNotes find_periodicity(const PeriodicityConfig& config, ProcessResult& result);
StageNotes estimate_compliance(const Recording& recording, const ProcessConfig& config, ProcessResult& result);
StageNotes estimate_stiffness(const StiffnessConfig& config, ProcessResult& result);

// fit; the texture is joined from it and others by join_texture().
StageNotes fit_texture(const FitFourier1dConfig& config, ProcessResult& result);
Texture join_texture(const Recording& recording, const ProcessConfig& config, const ProcessResult& result);

// accuracy. A truth that does not fit says nothing against the measurement.
StageNotes compare_with_truth(const Recording& recording, const ComparisonConfig& config, ProcessResult& result);

}  // namespace asperity::stage
