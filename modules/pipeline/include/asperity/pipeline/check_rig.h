#pragma once

#include <span>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/rig_check.h"
#include "asperity/pipeline/sine_grating.h"
#include "asperity/recording/inspect_recording.h"
#include "asperity/recording/recording.h"

namespace asperity {

// The defaults lie at two to five times what the bench's rig shows whose calibration is as good as a careful person's:
// docs/check-rig.md has its figures and their command.
struct RigLimits {
  int strokes = 5;
  double pitch = 0.005;
  double depth = 0.02;
  double pitch_repeatability = 0.004;
  double depth_repeatability = 0.02;
  double along_m = 40e-6;
  double correlation = 0.985;
  double latency_s = 1e-3;
  double latency_sigmas = 2.0;
  double latency_repeatability_s = 2.5e-3;
  double gravity = 0.015;
  double gravity_angle_rad = 0.03;
  double noise = 1.5;
  double outlying = 0.05;
  double lost = 0.05;

  template <class V>
  void visit(V& v) {
    v.field("strokes", strokes, "fewer leave the verdict limited", {1.0, 1000.0});
    v.field("pitch", pitch, "deviation of the mean pitch, share", {0.0, 1.0});
    v.field("depth", depth, "deviation of the mean depth, share", {0.0, 1.0});
    v.field("pitch_repeatability", pitch_repeatability, "standard deviation over the strokes, share", {0.0, 1.0});
    v.field("depth_repeatability", depth_repeatability, "standard deviation over the strokes, share", {0.0, 1.0});
    v.field("along_m", along_m, "wander of the arc length beside the grating's, RMS, mean, m", {0.0, 1.0});
    v.field("correlation", correlation, "of the profile with the traced sine, at least, mean", {0.0, 1.0});
    v.field("latency_s", latency_s, "of the tracker, beside the calibrated one, s", {0.0, 1.0});
    v.field("latency_sigmas", latency_sigmas,
            "the same in standard errors of the calibrated one; both must be exceeded", {0.0, 100.0});
    v.field("latency_repeatability_s", latency_repeatability_s, "standard deviation over the strokes, s", {0.0, 1.0});
    v.field("gravity", gravity, "deviation at rest, mean, share", {0.0, 1.0});
    v.field("gravity_angle_rad", gravity_angle_rad, "of the accelerometer's up to the world's at rest, median, rad",
            {0.0, 3.15});
    v.field("noise", noise, "of the tracker, found over calibrated, median", {1.0, 100.0});
    v.field("outlying", outlying, "poses that disagree with the probe, share, mean", {0.0, 1.0});
    v.field("lost", lost, "lost rows of a stream, share, mean", {0.0, 1.0});
  }
};

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
// the strokes that gave a profile. Then what exceeds a limit is named, with the likeliest cause: pitch is a matter of
// the tracker's scale alone, depth of the accelerometer's, for at a hand's speed the relief is beyond what the tracker
// resolves. `right` is false with any fault, or with no stroke measured.
// Throws Error without a stroke or for a grating that the tip cannot trace, and Cancelled.
RigCheck check_rig(std::span<const NamedRecording> strokes, const CheckRigConfig& config,
                   const Observer& observer = {});

// The check as one JSON object (units in the key names, null for nan), and as lines for a person.
std::string rig_check_json(const RigCheck& check, const CheckRigConfig& config);
std::string rig_check_text(const RigCheck& check, const CheckRigConfig& config);

}  // namespace asperity
