#include "asperity/rig/check_rig.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/recording/fingerprint.h"
#include "asperity/signal/statistics.h"
#include "asperity/signal/student.h"

namespace asperity {

namespace {

template <class ValueOf>
std::vector<double> values_of(const std::vector<RigStroke>& strokes, ValueOf value_of) {
  std::vector<double> values;
  for (const RigStroke& stroke : strokes) {
    const double value = value_of(stroke);
    if (stroke.measured && std::isfinite(value)) values.push_back(value);
  }
  return values;
}

template <class ValueOf>
RepeatedMeasurement repeated(const std::vector<RigStroke>& strokes, ValueOf value_of) {
  const std::vector<double> values = values_of(strokes, value_of);
  RepeatedMeasurement out;
  out.count = values.size();
  if (values.empty()) return out;
  out.mean = mean(values);
  if (values.size() < 2) return out;
  out.deviation = standard_deviation(values);
  const auto count = static_cast<double>(values.size());
  out.half_width = student_quantile(0.95, count - 1.0) * out.deviation / std::sqrt(count);
  return out;
}

double traced_rq_m(const TracedSine& sine) {
  constexpr int kSteps = 256;
  std::vector<double> heights(kSteps);
  for (int i = 0; i < kSteps; ++i) {
    heights[static_cast<std::size_t>(i)] = sine.height_m(2.0 * std::numbers::pi * i / kSteps);
  }
  const double middle = mean(heights);
  for (double& height : heights) height -= middle;
  return rms(heights);
}

double find_metric(const TrajectoryResult& trajectory, const char* name) {
  const auto found = trajectory.metrics.find(name);
  return found == trajectory.metrics.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

// The quietest stretch counts as rest by the accelerometer alone: a noisy tracker must not hide what it reads.
void measure_rest(const Recording& recording, const CheckRigConfig& config, RigStroke& out) {
  if (!out.inspection.quiet) return;
  const QuietInterval& quiet = *out.inspection.quiet;
  if (!(quiet.acceleration_noise_mps2.maxCoeff() < config.inspect.rest_acceleration_mps2)) return;
  out.gravity_share = quiet.gravity_mps2 / recording.info.gravity_world_mps2.norm();
  out.gravity_angle_rad = quiet.gravity_angle_rad;
}

double median_of(const std::vector<double>& values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : median(values);
}

void summarise_strokes(RigCheck& check) {
  const std::vector<RigStroke>& strokes = check.strokes;
  const auto angle = [](const RigStroke& s) { return s.gravity_angle_rad; };
  const auto noise = [](const RigStroke& s) { return s.tracker_noise_ratio; };
  check.pitch_m = repeated(strokes, [](const RigStroke& s) { return s.grating.pitch_m; });
  check.depth_m = repeated(strokes, [](const RigStroke& s) { return s.grating.depth_m; });
  check.Rq_m = repeated(strokes, [](const RigStroke& s) { return s.Rq_m; });
  check.shape_rms_m = repeated(strokes, [](const RigStroke& s) { return s.grating.shape_rms_m; });
  check.along_rms_m = repeated(strokes, [](const RigStroke& s) { return s.grating.along_rms_m; });
  check.correlation = repeated(strokes, [](const RigStroke& s) { return s.grating.correlation; });
  check.latency_s = repeated(strokes, [](const RigStroke& s) { return s.latency_s; });
  check.gravity_share = repeated(strokes, [](const RigStroke& s) { return s.gravity_share; });
  check.gravity_angle_rad = repeated(strokes, angle);
  check.tracker_noise_ratio = repeated(strokes, noise);
  check.outlying_share = repeated(strokes, [](const RigStroke& s) { return s.outlying_share; });
  check.lost_share = repeated(strokes, [](const RigStroke& s) {
    return std::max(s.inspection.probe.lost_share, s.inspection.tracker.lost_share);
  });
  check.median_gravity_angle_rad = median_of(values_of(strokes, angle));
  check.median_noise_ratio = median_of(values_of(strokes, noise));
}

// A surface that nothing is known of must show a line (docs/periodicity.md). Here the pitch is known: a wandering
// length broadens the line, and is to be named, so a period within a tenth of it that repeats is the grating's.
bool shows_grating(const Periodicity& found, const CheckRigConfig& config) {
  constexpr double kNear = 0.1, kLeastStrength = 0.3;
  return found.periodic || (std::abs(found.pitch_m / config.grating.pitch_m - 1.0) < kNear &&
                            found.strength >= kLeastStrength && found.periods >= 3);
}

void measure_stroke(const Recording& recording, const CheckRigConfig& config, const Observer& observer,
                    RigStroke& out) {
  const ProcessResult result = process_recording(recording, config.process, observer);
  out.verdicts = result.verdicts;
  out.latency_s = find_metric(result.trajectory, "latency_s") - recording.calibration.tracker.latency_s;
  out.accel_bias_mps2 = find_metric(result.trajectory, "accel_bias_mps2");
  out.tracker_noise_ratio = find_metric(result.trajectory, "tracker_noise_ratio");
  out.outlying_share = find_metric(result.trajectory, "poses_outlying_share");
  out.speed_mps = result.speed.mean_mps;
  if (result.roughness) out.Rq_m = result.roughness->Rq_m;
  if (!shows_grating(result.periodicity, config)) {
    out.why_not = "its profile has no period: was the grating scanned, across its ridges?";
    return;
  }
  out.median_depth_m = result.periodicity.depth_m;
  out.grating =
      measure_grating(result.profile, result.periodicity.pitch_m, config.grating, recording.calibration.tip_radius_m);
  if (!std::isfinite(out.grating.pitch_m)) {
    out.why_not = "its profile is too short: at least eight periods without a gap are needed";
    return;
  }
  // The line over the windows does not know their residuals' correlation; the other does.
  out.grating.pitch_stderr_m = std::fmax(out.grating.pitch_stderr_m, result.periodicity.pitch_stderr_m);
  out.measured = true;
}

RigEvidence evidence_of(const RigCheck& check, const Calibration& calibration, const CheckRigConfig& config) {
  RigEvidence out;
  for (const RigStroke& stroke : check.strokes) {
    out.strokes.push_back({stroke.name, stroke.measured, stroke.why_not, stroke.verdicts});
  }
  out.measured = check.pitch_m.count;
  out.calibrated = !calibration.uncalibrated;
  for (const char* kind : {"camera", "tracker", "force", "accel", "tip", "latency"}) {
    const auto found = calibration.calibrated.find(kind);
    if (found == calibration.calibrated.end()) {
      out.calibrations_unstated.emplace_back(kind);
    } else if (found->second.trustworthy == false) {
      out.calibrations_invalid.emplace_back(kind);
    }
  }
  out.pitch_m = check.pitch_m.mean;
  out.pitch_deviation_m = check.pitch_m.deviation;
  out.true_pitch_m = config.grating.pitch_m;
  out.depth_m = check.depth_m.mean;
  out.depth_deviation_m = check.depth_m.deviation;
  out.true_depth_m = config.grating.depth_m;
  out.along_rms_m = check.along_rms_m.mean;
  out.correlation = check.correlation.mean;
  out.shape_rms_m = check.shape_rms_m.mean;
  out.latency_s = check.latency_s.mean;
  out.latency_deviation_s = check.latency_s.deviation;
  out.latency_half_width_s = check.latency_s.half_width;
  out.calibrated_latency_s = calibration.tracker.latency_s;
  out.calibrated_latency_sigma_s = calibration.tracker.latency_sigma_s;
  out.strokes_at_rest = check.gravity_share.count;
  out.gravity_share = check.gravity_share.mean;
  out.gravity_angle_rad = check.median_gravity_angle_rad;
  out.noise_ratio = check.median_noise_ratio;
  out.outlying_share = check.outlying_share.mean;
  out.lost_share = check.lost_share.mean;
  return out;
}

}  // namespace

RigCheck check_rig(std::span<const NamedRecording> strokes, const CheckRigConfig& config, const Observer& observer) {
  std::vector<NamedFingerprint> measured_from;
  for (const NamedRecording& stroke : strokes) measured_from.push_back({stroke.name, fingerprint_of(stroke.recording)});
  check_independent(measured_from);
  if (strokes.empty()) throw Error("check-rig: the recordings hold no stroke");
  RigCheck check;
  for (const NamedRecording& stroke : strokes) {
    RigStroke& out = check.strokes.emplace_back();
    out.name = stroke.name;
    check.true_Rq_m = traced_rq_m(TracedSine(config.grating, stroke.recording.calibration.tip_radius_m));
    out.inspection = inspect_recording(stroke.recording, config.inspect);
    measure_rest(stroke.recording, config, out);
    try {
      measure_stroke(stroke.recording, config, observer, out);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      out.why_not = error.what();
    }
  }
  summarise_strokes(check);
  check.verdicts = judge_rig(evidence_of(check, strokes.front().recording.calibration, config), config.limits);
  check.right = is_trustworthy(check.verdicts);
  check.verdict = verdict_sentence(check.verdicts);
  return check;
}

}  // namespace asperity
