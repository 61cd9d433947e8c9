#include "asperity/verdict/judge_scan.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "asperity/verdict/verdict_codes.h"
#include "judge_streams.h"

namespace asperity {

namespace {

constexpr double kTwoSided95 = 1.96;
constexpr double kLeastContact_s = 0.1;
constexpr double kInvisible_snr = 2.0;  // 1, and the expected noise is known to a factor of about 2 in power
// With positions as uncertain as this, r is below 0.6 in about one scan of twenty (docs/verdicts-scans.md).
constexpr double kMisplaced_correlation = 0.75;
constexpr double kSeen_correlation = 0.9;  // of what the noise filter leaves with the surface
constexpr double kVibration_share = 0.1;   // of the texture's power
constexpr double kLargestLean_deg = 45.0;  // as hands hold a probe
constexpr std::size_t kFewSticks = 5;
constexpr double kStuck_share = 0.05;
constexpr double kNoisy_snr = 5.0;                  // a correlation with the surface of about 0.9
constexpr double kLeastCoverageWithoutForce = 0.9;  // near one surface, as a tip on it is
constexpr double kLeastSeen_share = 0.5;            // of the time, the object's body
constexpr double kMostlySeen_share = 0.95;
constexpr double kRad_per_degree = 0.017453292519943295;

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
  // In a typical stretch alone the whole path may have more noise: its expected correlation must be that of the least
  // SNR. A pattern goes over the whole path, and its line has been tested against the largest noise: where one is
  // found, the expected correlation need not be higher than that of the least SNR.
  const bool stands_out = (e.snr >= kInvisible_snr && !(e.expected_correlation < in_place * limit)) ||
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
        in_place * left < kMisplaced_correlation ? "positions_uncertain" : "positions_doubtful",
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
                                 "of the texture's {:.3g} µm RMS{}",
                                 e.vibration_Hz, 1e6 * e.vibration_rms_m, 1e6 * e.texture_rms_m,
                                 std::isfinite(e.snr) ? "; it counts as noise" : "")));
  }
  if (std::isfinite(e.may_be_hum_Hz)) {
    out.push_back(make_verdict(
        "may_be_hum",
        fmt::format("a wave of the texture passes the tip {:.4g} times a second, a multiple of the mains' frequency: "
                    "it could as well be hum",
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

void judge_force_range(const ScanEvidence& e, Verdicts& out) {
  if (!(e.force_limited_share > 0.0)) return;
  out.push_back(make_verdict(
      "force_clipped",
      fmt::format("{:.2g} % of the force's readings are at its highest value, {:.3g} N: the tip was pressed harder, or "
                  "the sensor does not resolve the force. Compliance, stiffness and friction are not determined",
                  100.0 * e.force_limited_share, e.force_limit_N)));
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
  if (e.probe_lean_deg > kLargestLean_deg) {
    out.push_back(make_verdict("normals_doubtful",
                               fmt::format("the probe leans by {:.0f}° from the normals that the path has: they are "
                                           "not the surface's",
                                           e.probe_lean_deg)));
  }
  judge_force_range(e, out);
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
  judge_streams(evidence, out);
  judge_object(evidence, out);
  judge_surface(evidence, out);
  sort_verdicts(out);
  return out;
}

}  // namespace asperity
