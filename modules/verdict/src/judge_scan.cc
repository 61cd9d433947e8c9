#include "asperity/verdict/judge_scan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

constexpr double kForceTolerance = 0.15;   // share: more than a calibration's scale, bias and alignment leave
constexpr double kClippedTolerance = 0.1;  // share of the mean specific force that clipping has taken away
constexpr double kNotByClipping = 2.0;     // factor: more than clipping takes away
constexpr double kLargestBias_mps2 = 1.5;  // five times the prior of a calibrated accelerometer
constexpr double kLatency_sigmas = 5.0;
constexpr double kLatencyAllowed_s = 0.5e-3;   // what a good calibration of the latency leaves
constexpr double kScaleAllowed = 0.005;        // what markers, camera and accelerometer leave of the scale
constexpr double kScale_sigmas = 3.3;          // one good scan in a thousand
constexpr double kScaleDoubtful_sigmas = 2.6;  // one in a hundred
constexpr double kAxes_chi2 = 27.9;            // 9 degrees of freedom, one in a thousand
constexpr double kUnrelated_sigma = 0.5;       // two of it are the whole scale
// Twenty times what a calibrated sensor has: heights would have that error in their gain.
constexpr double kUnexplainedMotion_share = 0.2;
constexpr double kNoise_ratio = 4.0;  // of the tracker, found over stated
constexpr double kOutlying_share = 0.2;
constexpr double kDeparture_ratio = 2.5;  // of the path from the poses, over their noise
constexpr double kTwoSided95 = 1.96;
constexpr double kLeastContact_s = 0.1;
constexpr double kInvisible_snr = 2.0;     // 1, and the expected noise is known to a factor of about 2 in power
constexpr double kSeen_correlation = 0.9;  // of what the noise filter leaves with the surface
constexpr double kFiltered_power = 0.04;   // the sensor has a fifth of its stated noise
constexpr double kRounding_power = 2.0;    // of rounding: no noise beside it
constexpr double kVibration_share = 0.1;   // of the texture's power
constexpr std::size_t kFewSticks = 5;
constexpr double kStuck_share = 0.05;
constexpr double kNoisy_snr = 5.0;                  // a correlation with the surface of about 0.9
constexpr double kLeastCoverageWithoutForce = 0.9;  // near one surface, as a tip on it is
constexpr double kLost_share = 0.2;                 // clipped, or dropped in reading
constexpr double kRepeated_share = 0.5;
constexpr double kLeastOverlap_share = 0.7;
constexpr double kLongestGap_s = 0.5;
constexpr double kRejected_share = 0.1;
constexpr double kLeastSeen_share = 0.5;  // of the time, the object's body
constexpr double kMostlySeen_share = 0.95;
constexpr double kRad_per_degree = 0.017453292519943295;

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

// The accelerometer against gravity and the poses. Fast motion is in both; clipping is named as such.
void judge_force(const ScanEvidence& e, Verdicts& out) {
  const double clipped_factor = std::max(e.clipped_force_ratio, 1.0 / e.clipped_force_ratio);
  const double worst_ratio = clipped_factor > kNotByClipping ? e.clipped_force_ratio : e.force_ratio;
  if (std::abs(worst_ratio - 1.0) > kForceTolerance) {
    out.push_back(make_verdict(
        "wrong_unit",
        fmt::format("the accelerometer reads {:.3g} times what gravity and the tracker's poses predict", worst_ratio)));
  } else if (e.force_difference_share > kForceTolerance) {
    out.push_back(make_verdict(
        "wrong_frame",
        fmt::format(
            "the accelerometer differs from the prediction of gravity and the tracker's poses by {:.0f} % of it",
            100.0 * e.force_difference_share)));
  }
  const bool clipped_away =
      clipped_factor <= kNotByClipping && std::abs(e.clipped_force_ratio - 1.0) > kClippedTolerance;
  if (clipped_away || e.clipped_share > kLost_share) {
    const std::string taken = clipped_away ? fmt::format(", which reduced its mean by {:.0f} %",
                                                         100.0 * std::abs(1.0 - e.clipped_force_ratio))
                                           : "";
    // What clipping adds to the noise is in the expected correlation: where that is high, little is lost.
    const bool repaired = e.expected_correlation >= kSeen_correlation;
    out.push_back(make_verdict(repaired ? "partly_clipped" : "clipped",
                               fmt::format("{:.2g} % of the accelerometer's samples are at the end of its "
                                           "range{}",
                                           100.0 * e.clipped_share, taken)));
  }
}

// A log-likelihood ratio of e⁹ : 1 decides, as between two poses on a mesh. It never refuses: errors of the inertial
// sensors that the model does not have (a probe that rings or clips on a rough surface) can favour wrong axes as well.
constexpr double kDecisive = 9.0;

// Whether tracker and inertial sensors show the same motion.
void judge_agreement(const ScanEvidence& e, Verdicts& out) {
  const double scale_sigmas = std::abs(e.tracker_scale_error) / e.tracker_scale_error_sigma;
  const std::string scale = fmt::format("the tracker's motion is {:.3f} ± {:.3f} times that of the inertial sensors",
                                        1.0 + e.tracker_scale_error, e.tracker_scale_error_sigma);
  // Certain, and more than calibrations leave: wrong. Certain alone: lengths are off by that.
  const double beyond_sigmas = std::abs(e.tracker_scale_error) / std::hypot(e.tracker_scale_error_sigma, kScaleAllowed);
  if (beyond_sigmas > kScale_sigmas) {
    out.push_back(make_verdict("scale_disagrees", scale));
  } else if (scale_sigmas > kScaleDoubtful_sigmas) {
    out.push_back(make_verdict("scale_doubtful", scale));
  }
  // A scale that could as well be none: nothing shows that both are of one motion.
  if (e.tracker_scale_error_sigma > kUnrelated_sigma) {
    out.push_back(
        make_verdict("motions_disagree", fmt::format("the inertial sensors do not show the tracker's motion: its "
                                                     "scale comes out to ± {:.0f} % only",
                                                     100.0 * e.tracker_scale_error_sigma)));
    return;
  }
  if (e.other_axes_log_ratio > -kDecisive) {
    out.push_back(make_verdict(
        "axes_unseen",
        fmt::format("with exchanged or negative axes the tracker's motion fits the inertial sensors {}",
                    e.other_axes_log_ratio > 0.0 ? fmt::format("better (e^{:.0f} : 1)", e.other_axes_log_ratio)
                                                 : "nearly as well")));
  }
  const double axes_chi2 = std::fmax(e.tracker_axes_chi2, e.accel_axes_chi2);
  if (axes_chi2 > kAxes_chi2) {
    out.push_back(make_verdict("motions_disagree",
                               fmt::format("tracker and accelerometer show different motions: χ² = {:.0f} for an error "
                                           "of their axes and scales, where 9 is expected",
                                           axes_chi2)));
  } else if (e.accel_motion_share > kUnexplainedMotion_share) {
    out.push_back(make_verdict("motions_disagree", fmt::format("{:.0f} % of the accelerometer's motion is not in the "
                                                               "tracker's",
                                                               100.0 * e.accel_motion_share)));
  }
}

// A filter or an average has taken the sensor's noise, and the surface's vibrations with it.
void judge_bandwidth(const ScanEvidence& e, Verdicts& out) {
  if (!(e.accel_floor_ratio < kFiltered_power && e.accel_rounding_ratio < kRounding_power)) return;
  const std::string waves =
      e.mean_speed_mps > 0.0 ? fmt::format(": waves shorter than {:.2g} mm are missing, and longer ones may be too low",
                                           1e3 * e.mean_speed_mps / e.accel_quiet_from_Hz)
                             : "";
  out.push_back(make_verdict(
      "accel_filtered", fmt::format("the accelerometer was low-passed: above {:.3g} Hz it has {:.2g} % of the power "
                                    "of its own noise{}",
                                    e.accel_quiet_from_Hz, 100.0 * e.accel_floor_ratio, waves)));
}

void judge_calibration(const ScanEvidence& e, Verdicts& out) {
  if (!e.calibrated) out.push_back(make_verdict("uncalibrated", "it was recorded without a calibration"));
  const std::size_t before = out.size();
  judge_force(e, out);
  // A bias is what clipping, a wrong unit or a wrong axis leave in the estimate: not named twice.
  if (out.size() == before && e.accel_bias_mps2 > kLargestBias_mps2) {
    out.push_back(
        make_verdict("wrong_frame", fmt::format("the accelerometer's bias would be {:.2g} m/s²", e.accel_bias_mps2)));
  }
  const double late_sigmas =
      std::abs(e.latency_beyond_prior_s) / std::hypot(e.latency_beyond_prior_sigma_s, kLatencyAllowed_s);
  if (late_sigmas > kLatency_sigmas) {
    out.push_back(make_verdict(
        "latency_off", fmt::format("the two streams differ by {:.2g} ± {:.2g} ms from the calibrated latency, {:.0f} "
                                   "standard deviations",
                                   1e3 * e.latency_beyond_prior_s, 1e3 * e.latency_beyond_prior_sigma_s, late_sigmas)));
  }
  // A clipped accelerometer shows another motion than the tracker: not named twice.
  const bool clipped = std::any_of(out.begin(), out.end(), [](const Verdict& v) { return v.code == "clipped"; });
  if (!clipped) judge_agreement(e, out);
}

void judge_streams(const ScanEvidence& e, Verdicts& out) {
  if (e.tracker_noise_ratio > kNoise_ratio) {
    out.push_back(make_verdict("tracker_noise", fmt::format("the tracker's residuals are {:.0f} times its calibrated "
                                                            "noise",
                                                            e.tracker_noise_ratio)));
  }
  const std::size_t poses = e.poses_used + e.poses_outlying;
  if (e.departure_ratio > kDeparture_ratio) {
    out.push_back(make_verdict(
        "poses_disagree", fmt::format("the path is {:.2g} mm from the tracker's poses, {:.0f} times what their noise "
                                      "makes",
                                      1e3 * e.departure_m, e.departure_ratio)));
  } else if (share(e.poses_outlying, poses) > kOutlying_share) {
    out.push_back(make_verdict("poses_outlying",
                               fmt::format("{} of {} tracker poses were down-weighted", e.poses_outlying, poses)));
  }
  if (e.repeated_share > kRepeated_share)
    out.push_back(make_verdict("tracker_repeats", "the tracker repeats the same pose"));
  if (share(e.rows_dropped, e.rows_kept + e.rows_dropped) > kLost_share) {
    out.push_back(make_verdict(
        "rows_lost", fmt::format("{} of {} rows could not be used", e.rows_dropped, e.rows_kept + e.rows_dropped)));
  }
  if (e.rows_changed > 0) {
    out.push_back(make_verdict("changed_bytes", fmt::format("at least {} row{} {} not as recorded, or missing, by "
                                                            "checksums.txt",
                                                            e.rows_changed, e.rows_changed == 1 ? "" : "s",
                                                            e.rows_changed == 1 ? "is" : "are")));
  }
  if (e.used_s < kLeastOverlap_share * e.recorded_s) {
    out.push_back(make_verdict("little_overlap", fmt::format("the two streams share only {:.1f} s of the {:.1f} s "
                                                             "recorded",
                                                             e.used_s, e.recorded_s)));
  }
  if (e.tracker_gap_s > kLongestGap_s) {
    out.push_back(make_verdict("tracker_gap", fmt::format("the tracker lost the marker for {:.2f} s, which was "
                                                          "interpolated over",
                                                          e.tracker_gap_s)));
  }
  if (share(e.samples_rejected, e.samples) > kRejected_share) {
    out.push_back(make_verdict(
        "spikes", fmt::format("{} of {} probe samples were rejected as spikes", e.samples_rejected, e.samples)));
  }
}

void judge_object(const ScanEvidence& e, Verdicts& out) {
  const std::string seen =
      fmt::format("the object's markers were seen in {:.0f} % of the scan", std::floor(100.0 * e.object_seen_share));
  if (e.object_seen_share < kLeastSeen_share) {
    out.push_back(make_verdict("object_unseen", seen));
  } else if (e.object_seen_share < kMostlySeen_share) {
    out.push_back(make_verdict("object_hidden", seen + "; the rest was left out"));
  }
  if (std::isfinite(e.object_moved_m)) {
    out.push_back(
        make_verdict("object_moved", fmt::format("the scan is relative to the object, which moved by up to "
                                                 "{:.3g} mm and {:.2g}°",
                                                 1e3 * e.object_moved_m, e.object_turned_rad / kRad_per_degree)));
  }
}

void judge_length(const ScanEvidence& e, Verdicts& out) {
  const double own_m = std::isfinite(e.length_stderr_m) ? e.length_stderr_m : 0.0;
  const double bound_m = kTwoSided95 * std::hypot(own_m, e.tracker_length_stderr_m);
  if (!(std::abs(e.length_m - e.tracker_length_m) > bound_m)) return;
  out.push_back(
      make_verdict("length_disagrees",
                   fmt::format("the tip's path is {:.2f} mm long, by the tracker's poses alone {:.2f} ± {:.2f} mm "
                               "(joint 95 %)",
                               1e3 * e.length_m, 1e3 * e.tracker_length_m, 1e3 * bound_m)));
}

void judge_noise(const ScanEvidence& e, Verdicts& out) {
  if (!e.error_known) {
    out.push_back(make_verdict("error_unknown", "the method states no error of its heights"));
    return;
  }
  if (!std::isfinite(e.snr)) {
    out.push_back(make_verdict("error_unknown", "the noise of the texture is not known"));
    return;
  }
  // What noise alone leaves of the correlation, and what the length's error leaves of that.
  const double in_place = std::isfinite(e.stretch_correlation) ? e.stretch_correlation : 1.0;
  const double by_noise = std::sqrt(e.snr / (1.0 + e.snr)), limit = std::sqrt(kInvisible_snr / (1.0 + kInvisible_snr));
  // By the whole path's power a few events stand out too: something must do so in a typical stretch (snr is of that).
  // A pattern goes over the whole path, and its line has been tested against the largest noise: where one is found,
  // the expected correlation need not be higher than that of the least SNR.
  const bool stands_out = e.snr >= kInvisible_snr ||
                          (e.snr > 0.0 && e.expected_correlation >= in_place * kSeen_correlation) ||
                          (e.pattern_found && e.expected_correlation >= in_place * limit);
  if (!stands_out) {
    out.push_back(
        make_verdict("below_noise", fmt::format("the texture is not above its noise: it is below the resolution of "
                                                "this probe, at most {:.3g} µm RMS in {:.3g} µm of expected noise",
                                                1e6 * e.at_most_m, 1e6 * e.noise_rms_m)));
    return;
  }
  // What noise leaves: by the SNR or, where a line stands out of it, by the expected correlation.
  const double seen = e.expected_correlation / in_place;
  const double left = seen > by_noise ? seen : by_noise;
  if (in_place * left < limit && !(e.expected_correlation >= kSeen_correlation) && in_place < left) {
    out.push_back(make_verdict(
        "positions_uncertain",
        fmt::format("the path's length has an error that moves heights by up to {:.2g} mm (standard deviation) from "
                    "their positions: the expected correlation with the surface is {:.2f}. Roughness and the ratio of "
                    "lengths are not affected",
                    1e3 * e.end_place_sigma_m, in_place * left)));
  }
  if (e.snr < kNoisy_snr) {
    out.push_back(
        make_verdict("noisy_texture", fmt::format("of the texture's {:.3g} µm RMS {:.3g} µm are expected to be noise",
                                                  1e6 * e.texture_rms_m, 1e6 * e.noise_rms_m)));
  }
}

void judge_vibration(const ScanEvidence& e, Verdicts& out) {
  const double measured_m2 = e.texture_rms_m * e.texture_rms_m;
  if (e.vibration_rms_m * e.vibration_rms_m >= kVibration_share * measured_m2) {
    out.push_back(make_verdict(
        "vibration", fmt::format("a vibration of {:.4g} Hz that is not of the surface is in the heights: {:.3g} "
                                 "of the texture's {:.3g} µm RMS; it counts as noise",
                                 e.vibration_Hz, 1e6 * e.vibration_rms_m, 1e6 * e.texture_rms_m)));
  }
  if (std::isfinite(e.may_be_hum_Hz)) {
    out.push_back(make_verdict(
        "may_be_hum",
        fmt::format("the pattern passes the tip {:.4g} times a second, a multiple of the mains' frequency, "
                    "at so even a speed that it could as well be hum",
                    e.may_be_hum_Hz)));
  }
}

void judge_sticking(const ScanEvidence& e, Verdicts& out) {
  if (e.sticks < kFewSticks || !(e.stuck_share >= kStuck_share)) return;
  out.push_back(make_verdict(
      "stick_slip",
      fmt::format(
          "the tip stuck and slipped {} times ({:.0f} % of the contact): the vibration of the jumps is in the heights",
          e.sticks, 100.0 * e.stuck_share)));
}

void judge_surface(const ScanEvidence& e, Verdicts& out) {
  if (!e.measured) return;
  if (e.reads_no_contact) {
    out.push_back(make_verdict("nothing_touched", "the force sensor reads no contact throughout"));
    return;
  }
  if (e.contact_s < kLeastContact_s) {
    out.push_back(make_verdict("nothing_touched", e.contact_s > 0.0
                                                      ? fmt::format("the tip touched for {:.2g} s only", e.contact_s)
                                                      : std::string("the tip did not touch a surface")));
    return;
  }
  if (!e.no_profile.empty()) {
    out.push_back(make_verdict("no_profile", "the profile is missing: " + e.no_profile));
    return;
  }
  // Within its own width a tip meets one place only.
  if (e.length_m < 2.0 * e.tip_radius_m || e.length_m < kTwoSided95 * e.length_stderr_m) {
    out.push_back(
        make_verdict("not_moved", fmt::format("the tip moved {:.2g} mm only while in contact", 1e3 * e.length_m)));
    return;
  }
  if (!e.has_force && e.covered < kLeastCoverageWithoutForce) {
    out.push_back(make_verdict("nothing_touched", fmt::format("force was not measured, and only {:.0f} % of the path "
                                                              "is near one surface: nothing shows that the tip touched",
                                                              100.0 * e.covered)));
    return;
  }
  if (e.covered < e.min_coverage) {
    out.push_back(
        make_verdict("little_coverage", fmt::format("only {:.0f} % of the profile has heights", 100.0 * e.covered)));
  }
  if (!e.has_force) {
    out.push_back(
        make_verdict("contact_unknown",
                     "the force never changes: where the tip touched is not known, and all of the path counts "
                     "as scanned"));
  }
  judge_length(e, out);
  judge_noise(e, out);
  judge_passes(e.passes, out);
  judge_vibration(e, out);
  judge_sticking(e, out);
  if (!e.no_roughness.empty()) out.push_back(make_verdict("no_roughness", "roughness is missing: " + e.no_roughness));
  if (!e.no_texture.empty()) out.push_back(make_verdict("no_texture", "the texture is missing: " + e.no_texture));
}

}  // namespace

Verdicts judge_scan(const ScanEvidence& evidence) {
  Verdicts out;
  judge_calibration(evidence, out);
  judge_bandwidth(evidence, out);
  judge_streams(evidence, out);
  judge_object(evidence, out);
  judge_surface(evidence, out);
  sort_verdicts(out);
  return out;
}

}  // namespace asperity
