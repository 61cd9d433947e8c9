#pragma once

#include <span>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/recording/inspect_recording.h"
#include "asperity/recording/recording.h"
#include "asperity/rig/rig_check.h"
#include "asperity/rig/sine_grating.h"
#include "asperity/verdict/judge_rig.h"

namespace asperity {

struct CheckRigConfig {
  SineGratingConfig grating;
  RigLimits limits;
  InspectConfig inspect;
  ProcessConfig process;

  template <class V>
  void visit(V& v) {
    v.group("grating", grating);
    v.group("limits", limits);
    v.group("inspect", inspect);
    process.visit(v);
  }
};

struct NamedRecording {
  std::string name;
  Recording recording;
};

// Each recording is one stroke over a sine grating. Every stroke is inspected and processed (process_recording.h) and
// laid beside the sine (measure_grating.h); means, standard deviations and 95 % intervals of the mean are taken over
// the strokes that gave a profile, and judge_rig decides over them.
// Throws Error without a stroke or for a grating that the tip cannot trace, and Cancelled.
RigCheck check_rig(std::span<const NamedRecording> strokes, const CheckRigConfig& config,
                   const Observer& observer = {});

// The check as one JSON object (units in the key names, null for nan), and as lines for a person.
std::string rig_check_json(const RigCheck& check, const CheckRigConfig& config);
std::string rig_check_text(const RigCheck& check, const CheckRigConfig& config);

}  // namespace asperity
