#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "asperity/verdict/verdict.h"

namespace asperity {

// The defaults are two to five times what the bench's rig shows whose calibration is as good as a careful person's:
// docs/check-rig.md has its metrics and their command.
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
    v.field("along_m", along_m, "deviation of the arc length from the grating's, RMS, mean, m", {0.0, 1.0});
    v.field("correlation", correlation, "of the profile with the traced sine, at least, mean", {0.0, 1.0});
    v.field("latency_s", latency_s, "of the tracker, from the calibrated one, s", {0.0, 1.0});
    v.field("latency_sigmas", latency_sigmas,
            "the same in standard errors of the calibrated one; both must be exceeded", {0.0, 100.0});
    v.field("latency_repeatability_s", latency_repeatability_s, "standard deviation over the strokes, s", {0.0, 1.0});
    v.field("gravity", gravity, "deviation while stationary, mean, share", {0.0, 1.0});
    v.field("gravity_angle_rad", gravity_angle_rad,
            "angle between the accelerometer's up and the world's while stationary, median, rad", {0.0, 3.15});
    v.field("noise", noise, "of the tracker, found over calibrated, median", {1.0, 100.0});
    v.field("outlying", outlying, "poses that disagree with the probe, share, mean", {0.0, 1.0});
    v.field("lost", lost, "lost rows of a stream, share, mean", {0.0, 1.0});
  }
};

// What strokes over a known grating show of the rig: numbers, no judgement. nan: not known, and then nothing is
// concluded from it. Means and standard deviations are over the strokes that gave a profile.
struct RigEvidence {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  struct Stroke {
    std::string name;
    bool measured = false;
    std::string why_not;  // if not measured
    Verdicts verdicts;    // of the stroke as a scan
  };
  std::vector<Stroke> strokes;
  std::size_t measured = 0;  // strokes with a profile

  bool calibrated = true;
  std::vector<std::string> calibrations_invalid;   // kinds that were invalid when they were made
  std::vector<std::string> calibrations_unstated;  // kinds whose origin the calibration does not state

  double pitch_m = kUnknown, pitch_deviation_m = kUnknown, true_pitch_m = kUnknown;
  double depth_m = kUnknown, depth_deviation_m = kUnknown, true_depth_m = kUnknown;
  double along_rms_m = kUnknown;  // how the arc length wanders beside the grating's
  double correlation = kUnknown, shape_rms_m = kUnknown;
  double latency_s = kUnknown;  // of the tracker, less the calibrated one
  double latency_deviation_s = kUnknown;
  double latency_half_width_s = kUnknown;  // of the mean's 95 % interval
  double calibrated_latency_s = kUnknown, calibrated_latency_sigma_s = kUnknown;
  std::size_t strokes_at_rest = 0;      // those with a static interval
  double gravity_share = kUnknown;      // at rest: the accelerometer's reading over gravity
  double gravity_angle_rad = kUnknown;  // at rest: of its up to the world's, median
  double noise_ratio = kUnknown;        // of the tracker, found over calibrated, median
  double outlying_share = kUnknown;     // of the poses
  double lost_share = kUnknown;         // of the rows of a stream
};

// The verdicts on a rig, the worst first, those of its strokes with the stroke's name before the message. Pitch is a
// matter of the tracker's scale alone, depth of the accelerometer's: at a hand's speed the relief is beyond what the
// tracker resolves. Where one finding explains another, the remedy is that of the first.
Verdicts judge_rig(const RigEvidence& evidence, const RigLimits& limits);

}  // namespace asperity
