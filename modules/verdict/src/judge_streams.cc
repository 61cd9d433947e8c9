#include "judge_streams.h"

#include <algorithm>
#include <cmath>
#include <string>

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
constexpr double kChangeAllowed_s = 1e-3;      // of the latency over a recording: what two such calibrations leave
constexpr double kScaleAllowed = 0.005;        // what markers, camera and accelerometer leave of the scale
constexpr double kScale_sigmas = 3.3;          // one good scan in a thousand
constexpr double kScaleDoubtful_sigmas = 2.6;  // one in a hundred
constexpr double kAxes_chi2 = 27.9;            // 9 degrees of freedom, one in a thousand
// Peaks that were cut off and restored are another motion too, of the accelerometer alone: its own axes say less then.
constexpr double kCutPeaks_share = 0.01;
constexpr double kAxesOfCutPeaks_chi2 = 2.0 * kAxes_chi2;
constexpr double kUnrelated_sigma = 0.5;  // two of it are the whole scale
// Twenty times what a calibrated sensor has: heights would have that error in their gain.
constexpr double kUnexplainedMotion_share = 0.2;
constexpr double kNoise_ratio = 4.0;  // of the tracker, found over stated
constexpr double kOutlying_share = 0.2;
constexpr double kDeparture_ratio = 2.5;  // of the path from the poses, over their noise
constexpr double kFiltered_power = 0.04;  // the sensor has a fifth of its stated noise
constexpr double kRounding_power = 2.0;   // of rounding: no noise beside it
constexpr double kUnrounded_power =
    1e-3;                            // of readings that are not whole: no calibration's misfit is 30 times its noise
constexpr double kLost_share = 0.2;  // clipped, or dropped in reading
constexpr double kRepeated_share = 0.5;
constexpr double kLeastOverlap_share = 0.7;
constexpr double kLongestGap_s = 0.5;
constexpr double kRejected_share = 0.1;

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
    out.push_back(make_verdict("clipped", fmt::format("{:.2g} % of the accelerometer's samples are at the end of its "
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
  const bool by_cut_peaks = e.clipped_share > kCutPeaks_share && !(e.tracker_axes_chi2 > kAxes_chi2) &&
                            e.accel_axes_chi2 <= kAxesOfCutPeaks_chi2 &&
                            !(e.accel_motion_share > kUnexplainedMotion_share);
  if (axes_chi2 > kAxes_chi2 && by_cut_peaks) {
    out.push_back(
        make_verdict("peaks_clipped",
                     fmt::format("{:.2g} % of the accelerometer's samples are at the end of its range, and its motion "
                                 "differs from the tracker's (χ² = {:.0f}, where 9 is expected): heights may be too "
                                 "small",
                                 100.0 * e.clipped_share, axes_chi2)));
  } else if (axes_chi2 > kAxes_chi2) {
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

// Gyroscope and tracker: axes, signs and unit of the angular rate.
void judge_rotation(const ScanEvidence& e, Verdicts& out) {
  if (!(e.gyro_axes_chi2 > kAxes_chi2)) return;
  out.push_back(make_verdict("rotations_disagree",
                             fmt::format("tracker and gyroscope show different rotations: χ² = {:.0f} for an error of "
                                         "the gyroscope's axes and scales, where 9 is expected",
                                         e.gyro_axes_chi2)));
}

// A filter or an average has taken the sensor's noise, and the surface's vibrations with it.
void judge_bandwidth(const ScanEvidence& e, Verdicts& out) {
  const bool whole = std::isfinite(e.accel_rounding_ratio);
  if (!(e.accel_floor_ratio < (whole ? kFiltered_power : kUnrounded_power))) return;
  if (whole && !(e.accel_rounding_ratio < kRounding_power)) return;
  const std::string waves =
      e.mean_speed_mps > 0.0 ? fmt::format(": waves shorter than {:.2g} mm are missing, and longer ones may be too low",
                                           1e3 * e.mean_speed_mps / e.accel_quiet_from_Hz)
                             : "";
  out.push_back(make_verdict("accel_filtered",
                             fmt::format("the accelerometer was low-passed, or its stated noise is too large: above "
                                         "{:.3g} Hz it has {:.2g} % of the power of that noise{}",
                                         e.accel_quiet_from_Hz, 100.0 * e.accel_floor_ratio, waves)));
}

// Two clocks of which one drifts or jumps. Where the latency is wrong as a whole, that is the reason.
void judge_latency_change(const ScanEvidence& e, Verdicts& out) {
  if (std::any_of(out.begin(), out.end(), [](const Verdict& v) { return v.code == "latency_off"; })) return;
  const double sigmas = std::abs(e.latency_change_s) / std::hypot(e.latency_change_sigma_s, kChangeAllowed_s);
  if (!(sigmas > kLatency_sigmas)) return;
  out.push_back(make_verdict(
      "clocks_drift", fmt::format("from the first pose to the last, the tracker's clock departs from the probe's by "
                                  "{:.2g} ± {:.2g} ms, {:.0f} standard deviations",
                                  1e3 * e.latency_change_s, 1e3 * e.latency_change_sigma_s, sigmas)));
}

}  // namespace

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
  judge_latency_change(e, out);
  judge_bandwidth(e, out);
  // A clipped accelerometer shows another motion than the tracker: not named twice.
  const bool clipped = std::any_of(out.begin(), out.end(), [](const Verdict& v) { return v.code == "clipped"; });
  if (!clipped) judge_agreement(e, out);
  judge_rotation(e, out);
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

}  // namespace asperity
