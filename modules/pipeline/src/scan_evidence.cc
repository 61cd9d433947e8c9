#include "asperity/pipeline/scan_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "asperity/base/units.h"
#include "asperity/pipeline/accelerometer_floor.h"
#include "asperity/pipeline/compare_specific_force.h"
#include "asperity/pipeline/compare_with_tracker.h"
#include "asperity/pipeline/reference.h"
#include "asperity/profile/find_contact.h"
#include "asperity/profile/line_over_time.h"
#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

constexpr double kLineOfThePath = 0.5;  // power over time by that over the path

double span_s(const std::vector<std::int64_t>& t_ns) {
  return t_ns.size() < 2 ? 0.0 : static_cast<double>(t_ns.back() - t_ns.front()) * kNanosecond_s;
}

double repeated_share(const TrackerStream& tracker) {
  if (tracker.size() == 0) return 0.0;
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < tracker.size(); ++i) {
    const Pose& a = tracker.T_world_marker[i - 1];
    const Pose& b = tracker.T_world_marker[i];
    repeated += a.translation_m == b.translation_m && a.rotation.coeffs() == b.rotation.coeffs() ? 1 : 0;
  }
  return static_cast<double>(repeated) / static_cast<double>(tracker.size());
}

std::size_t dropped_rows(const Recording& recording) {
  std::size_t dropped = 0;
  for (const Problem& problem : recording.problems) {
    constexpr std::array<std::string_view, 5> kDropped{"duplicate_time", "bad_acceleration", "bad_quaternion",
                                                       "position_far_off", "time_far_off"};
    if (std::find(kDropped.begin(), kDropped.end(), problem.kind) != kDropped.end()) dropped += problem.count;
  }
  return dropped;
}

std::size_t changed_rows(const Recording& recording) {
  std::size_t changed = 0;
  for (const Problem& problem : recording.problems) changed += problem.kind == "changed" ? problem.count : 0;
  return changed;
}

// Why a stage has no result; empty if no problem of the kind is there.
std::string why_absent(const Problems& problems, std::string_view kind) {
  for (const Problem& problem : problems) {
    if (problem.kind != kind) continue;
    const std::size_t colon = problem.message.find(": ");
    return colon == std::string::npos ? problem.message : problem.message.substr(colon + 2);
  }
  return {};
}

double metric_of(const TrajectoryResult& trajectory, const char* name) {
  const auto found = trajectory.metrics.find(name);
  return found == trajectory.metrics.end() ? ScanEvidence::kUnknown : found->second;
}

// Two estimates of the tracker's scale: of the smoother's innovations, which are of all frequencies and know the noise
// that the smoother has learnt, and of windows of a second, which assume less of what is fast (a marker that shakes, a
// filter in one of the sensors) and more of what is slow. A scale that is wrong is wrong in both; an error of one's
// model is in that one alone. Where they contradict one another, the one that is nearer to 1 in its own errors counts.
void prefer_windows(const SpecificForceComparison& force, ScanEvidence& out) {
  constexpr double kContradicts_sigmas = 3.3;  // one in a thousand
  // Its windows take the latency as it was estimated; of a real hand 5 ms of it are 0.3 to 0.4 % of the scale.
  constexpr double kOfLatency = 0.005;
  const double window_sigma = std::hypot(force.tracker_scale_error_sigma, kOfLatency);
  const double apart = std::abs(out.tracker_scale_error - force.tracker_scale_error);
  if (!(apart > kContradicts_sigmas * std::hypot(out.tracker_scale_error_sigma, window_sigma))) return;
  const bool is_nearer = std::abs(force.tracker_scale_error) * out.tracker_scale_error_sigma <
                         std::abs(out.tracker_scale_error) * window_sigma;
  if (!is_nearer) return;
  out.tracker_scale_error = force.tracker_scale_error;
  out.tracker_scale_error_sigma = window_sigma;
  if (std::isfinite(force.tracker_axes_chi2)) out.tracker_axes_chi2 = force.tracker_axes_chi2;
}

void add_streams(const Recording& recording, const TrajectoryResult& trajectory, ScanEvidence& out) {
  const auto metric = [&](const char* name) { return metric_of(trajectory, name); };
  const auto count = [&](const char* name) {
    const double value = metric(name);
    return value > 0.0 ? static_cast<std::size_t>(value) : 0;
  };
  out.calibrated = !recording.calibration.uncalibrated;
  out.has_force = has_force(recording);
  const auto latency = [&](const char* name, double calibrated_s) {
    const double estimated_s = metric(name);
    return std::isfinite(estimated_s) ? estimated_s : calibrated_s;
  };
  const SpecificForceComparison force =
      compare_specific_force(recording, latency("latency_s", recording.calibration.tracker.latency_s),
                             latency("probe_latency_s", recording.calibration.probe_latency_s));
  out.force_ratio = force.ratio;
  out.force_difference_share = force.difference_share;
  out.clipped_force_ratio = force.clipped_ratio;
  out.clipped_share = force.clipped_share;
  const AccelerometerFloor floor = accelerometer_floor(recording);
  out.accel_floor_ratio = floor.ratio;
  out.accel_rounding_ratio = floor.rounding_ratio;
  out.accel_quiet_from_Hz = floor.from_Hz;
  out.accel_bias_mps2 = metric("accel_bias_mps2");
  out.latency_s = metric("latency_s");
  out.latency_beyond_prior_s = metric("latency_beyond_prior_s");
  out.latency_beyond_prior_sigma_s = metric("latency_beyond_prior_sigma_s");
  out.latency_change_s = metric("latency_change_s");
  out.latency_change_sigma_s = metric("latency_change_sigma_s");
  out.tracker_scale_error = metric("tracker_scale_error");
  out.tracker_scale_error_sigma = metric("tracker_scale_error_sigma");
  out.tracker_axes_chi2 = metric("tracker_axes_chi2");
  prefer_windows(force, out);
  out.accel_axes_chi2 = metric("accel_axes_chi2");
  out.gyro_axes_chi2 = metric("gyro_axes_chi2");
  out.other_axes_log_ratio = metric("other_axes_log_ratio");
  out.accel_motion_share = metric("accel_motion_share");
  out.tracker_noise_ratio = metric("tracker_noise_ratio");
  out.poses_used = count("poses_used");
  out.poses_outlying = count("poses_outlying");
  out.repeated_share = repeated_share(recording.tracker);
  out.rows_dropped = dropped_rows(recording);
  out.rows_changed = changed_rows(recording);
  out.rows_kept = recording.probe.size() + recording.tracker.size();
  out.recorded_s = std::max(span_s(recording.probe.t_ns), span_s(recording.tracker.t_ns));
  out.used_s = span_s(trajectory.motion.t_ns);
  out.tracker_gap_s = metric("longest_tracker_gap_s");
  out.samples_rejected = count("rejected_samples");
  out.samples = recording.probe.size();
}

// The standard error of the length of the tip's own path, which the poses' has to agree with: without that of how much
// further above it the surface is.
double without_indentation(double length_stderr_m, const BasePathResult& base) {
  if (base.tip_s_m.empty() || !(base.indentation_m > 0.0)) return length_stderr_m;
  const double tip_m = *std::max_element(base.tip_s_m.begin(), base.tip_s_m.end());
  const double lift_sigma_m = (base.length_m - tip_m) * base.indentation_sigma_m / base.indentation_m;
  return std::sqrt(std::max(0.0, length_stderr_m * length_stderr_m - lift_sigma_m * lift_sigma_m));
}

}  // namespace

PoseEvidence pose_evidence(const RegistrationResult& registration) {
  PoseEvidence out;
  out.converged = registration.converged;
  out.iterations = registration.iterations;
  out.points = registration.points;
  out.outliers = registration.outliers;
  out.ambiguous = registration.ambiguous;
  if (registration.runner_up) {
    out.rival_distance_m = registration.runner_up->distance_m;
    out.rival_rotation_rad = registration.runner_up->rotation_rad;
  }
  const PoseRivals& rivals = registration.rivals;
  if (rivals.judged) {
    out.sigma_m = rivals.sigma_m;
    out.sigma_rad = rivals.sigma_rad;
    out.slow_ratio = rivals.slow_ratio;
    out.slow_ratio_sigma = rivals.slow_ratio_sigma;
    out.outlying = rivals.outlying;
    out.chance = rivals.chance;
    out.mirror_log_odds = rivals.mirror_log_odds;
    out.mesh_scale = rivals.scale.ratio;
    out.mesh_scale_sigma = rivals.scale.sigma;
    out.mesh_scale_gain = rivals.scale.gain;
    out.searched = rivals.searched;
    out.symmetric_copies = rivals.symmetric_copies;
    out.symmetric_motion = rivals.symmetric_motion;
  }
  const PoseMisfit& misfit = registration.misfit;
  out.slow_m = misfit.slow_m;
  out.explained_m = misfit.explained_m;
  out.extent_m = misfit.extent_m;
  out.off_share = misfit.off_share;
  out.off_limit_m = misfit.off_limit_m;
  out.off_m = misfit.off_m;
  if (registration.assumed) {
    out.assumed_drift_m = registration.assumed->sigma_m;
    out.assumed_length_m = registration.assumed->length_m;
    out.independent_assumed = !(registration.assumed->sigma_m > 0.0);
  }
  out.guess_shift_m = misfit.guess_shift_m;
  out.guess_rotation_rad = misfit.guess_rotation_rad;
  out.guess_sigma_m = misfit.guess_sigma_m;
  out.guess_sigma_rad = misfit.guess_sigma_rad;
  out.guess_stated = misfit.guess_stated;
  return out;
}

Verdicts judge_pose(const RegistrationResult& registration, bool guessed) {
  Verdicts out = judge_registration(pose_evidence(registration));
  constexpr double kGuess_m = 5e-3;  // known less well than this, a motion is known less well than from a guess by hand
  const bool arbitrary = std::any_of(registration.undetermined.begin(), registration.undetermined.end(),
                                     [](const UndeterminedMotion& motion) { return !(motion.sigma_m < kGuess_m); });
  // Where the pose was weighed, the standard deviations say it, and leave out what the mesh is its own image along.
  if (!guessed && arbitrary && !registration.rivals.judged) {
    out.push_back(make_verdict("pose_arbitrary",
                               "without a guess, the position of the scans along undetermined motions is arbitrary"));
    sort_verdicts(out);
  }
  return out;
}

bool has_force(const Recording& recording) {
  double first = std::numeric_limits<double>::quiet_NaN();
  const auto changes = [&](double counts) {
    if (!std::isfinite(counts)) return false;
    if (std::isfinite(first) && counts != first) return true;
    first = counts;
    return false;
  };
  if (std::any_of(recording.probe.force_counts.begin(), recording.probe.force_counts.end(), changes)) return true;
  if (!recording.calibration.force3) return false;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    first = std::numeric_limits<double>::quiet_NaN();
    for (const Eigen::Vector3d& counts : recording.probe.force3_counts) {
      if (changes(counts[axis])) return true;
    }
  }
  return false;
}

namespace {

// The force never changes, and is that of a tip in the air: a quiet sensor of few bits that was never pressed.
bool reads_no_contact(const Recording& recording, double touch_N) {
  if (!recording.info.has_force_sensor || recording.calibration.uncalibrated || has_force(recording)) return false;
  for (const double counts : recording.probe.force_counts) {
    if (std::isfinite(counts)) return recording.calibration.force.force_N(counts) < touch_N;
  }
  return false;
}

double length_m(const Profile& profile) {
  return profile.size() < 2 ? ScanEvidence::kUnknown : static_cast<double>(profile.size() - 1) * profile.spacing_m;
}

bool is_of_mains(const TimeLine& line) {
  constexpr int kMultiples = 6;
  constexpr double kMains_share = 1e-3;  // that the mains' frequency is off
  for (const double mains_Hz : {50.0, 60.0}) {
    for (int n = 1; n <= kMultiples; ++n) {
      const double at_Hz = n * mains_Hz;
      if (std::abs(line.frequency_Hz - at_Hz) <= 0.5 * line.resolution_Hz + kMains_share * at_Hz) return true;
    }
  }
  return false;
}

// The lines are sorted, the strongest first.
void add_vibrations(const TextureNoise& noise, ScanEvidence& out) {
  constexpr double kPart = 0.1;  // of the texture's power
  double power_m2 = 0.0;
  for (const TimeLine& line : noise.time_lines) {
    const double line_m2 = line.rms_m * line.rms_m;
    if (!line.could_be_surface) {
      if (power_m2 == 0.0) out.vibration_Hz = line.frequency_Hz;
      power_m2 += line_m2;
    } else if (!std::isfinite(out.may_be_hum_Hz) && is_of_mains(line) &&
               line_m2 > kPart * noise.texture_rms_m * noise.texture_rms_m) {
      out.may_be_hum_Hz = line.frequency_Hz;
    }
  }
  out.vibration_rms_m = std::sqrt(power_m2);
}

void add_measured(const Recording& recording, const ProcessResult& result, ScanEvidence& out) {
  const TrackerComparison tracker = compare_with_tracker(recording, result.trajectory, result.base);
  out.mean_speed_mps = result.speed.mean_mps;
  const double stated_m = recording.calibration.tracker.sigma_position_m.norm();
  out.departure_m = tracker.departure_m;
  // Poses that are better than stated are not evidence against a path that keeps to what is stated.
  out.departure_ratio = tracker.departure_m / (0.8 * std::max(stated_m, std::sqrt(3.0) * tracker.pose_noise_m));
  out.no_profile = why_absent(result.problems, "no_profile");
  out.measured = result.profile.size() > 0 || !out.no_profile.empty();
  if (!out.measured) return;
  out.no_roughness = why_absent(result.problems, "no_roughness");
  out.no_texture = why_absent(result.problems, "no_texture");
  const TipMotion& motion = result.trajectory.motion;
  if (out.has_force && motion.size() > 1) {
    const std::vector<char> contact = find_contact(motion, result.config.base.contact);
    const auto touching =
        static_cast<double>(std::count_if(contact.begin(), contact.end(), [](char c) { return c != 0; }));
    out.contact_s = span_s(motion.t_ns) * touching / static_cast<double>(contact.size());
  }
  out.reads_no_contact = reads_no_contact(recording, result.config.base.contact.touch_N);
  out.tip_radius_m = recording.calibration.tip_radius_m;
  if (recording.calibration.tip_in_marker_m.norm() > 0.0) out.probe_lean_deg = result.base.probe_tilt_deg;
  out.covered = result.coverage.covered;
  out.min_coverage = result.config.min_coverage;
  const Profile& profile = result.profile;
  out.error_known = profile.size() == 0 || std::any_of(profile.sigma_m.begin(), profile.sigma_m.end(),
                                                       [](double sigma_m) { return std::isfinite(sigma_m); });
  out.length_m = std::isfinite(tracker.length_m) ? tracker.length_m : length_m(profile);
  out.length_stderr_m = std::isfinite(result.noise.length_stderr_m)
                            ? without_indentation(result.noise.length_stderr_m, result.base)
                            : tracker.length_stderr_m;
  out.tracker_length_m = tracker.tracker_length_m;
  out.tracker_length_stderr_m = tracker.tracker_length_stderr_m;
  out.texture_rms_m = result.noise.texture_rms_m;
  out.noise_rms_m = result.noise.noise_rms_m;
  out.snr = result.noise.snr;
  out.expected_correlation = result.noise.expected_correlation;
  // Hum at a constant speed is a line too. Where a bent path smears the pattern's line, it does not count either.
  const Periodicity& pattern = result.periodicity;
  out.pattern_found = pattern.periodic && std::isfinite(pattern.pitch_stderr_m) &&
                      line_over_time(profile, profile.texture_m, pattern.pitch_m) < kLineOfThePath;
  add_vibrations(result.noise, out);
  out.stretch_correlation = result.noise.stretch_correlation;
  out.end_place_sigma_m = result.noise.end_place_sigma_m;
  out.at_most_m = result.noise.at_most_m;
  for (const RepeatedLine& line : result.lines) {
    const MergedProfile& merged = line.merged;
    if (!line.one_line) continue;
    if (!std::isfinite(merged.noise_ratio_low) || merged.noise_ratio_low <= out.passes.low) continue;
    out.passes = {merged.noise_ratio, merged.noise_ratio_low, merged.noise_ratio_high};
  }
  if (result.force_limit.is_limited()) out.force_limited_share = result.force_limit.share();
  out.force_limit_N = result.force_limit.limit_N;
  out.sticks = result.friction.sticks;
  out.stuck_share = result.friction.stuck_share;
}

}  // namespace

ScanEvidence scan_evidence(const Recording& recording, const ProcessResult& result) {
  ScanEvidence out;
  add_streams(recording, result.trajectory, out);
  out.object_seen_share = metric_of(result.trajectory, "object_seen_share");
  out.object_moved_m = metric_of(result.trajectory, "object_moved_m");
  out.object_turned_rad = metric_of(result.trajectory, "object_turned_rad");
  if (result.trajectory.object) {
    add_measured(recording_on_object(recording, result.trajectory), result, out);
  } else {
    add_measured(recording, result, out);
  }
  return out;
}

}  // namespace asperity
