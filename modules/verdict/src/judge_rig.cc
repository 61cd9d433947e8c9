#include "asperity/verdict/judge_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "asperity/base/text.h"
#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

class RigJudge {
 public:
  RigJudge(const RigEvidence& evidence, const RigLimits& limits) : e_(evidence), limits_(limits) {}

  Verdicts judge() {
    judge_calibration();
    judge_strokes();
    judge_streams();
    judge_repeatability();
    judge_pitch();
    judge_gravity();
    judge_depth();
    judge_shape();
    judge_latency();
    sort_verdicts(out_);
    return std::move(out_);
  }

 private:
  void say(std::string_view code, std::string message) { out_.push_back(make_verdict(code, std::move(message))); }
  void say(std::string_view code, std::string message, std::string remedy) {
    say(code, std::move(message));
    out_.back().remedy = std::move(remedy);
  }
  double pitch_error() const { return e_.pitch_m / e_.true_pitch_m - 1.0; }
  double depth_error() const { return e_.depth_m / e_.true_depth_m - 1.0; }
  double pitch_scatter() const { return e_.pitch_deviation_m / e_.pitch_m; }
  double gravity_error() const { return e_.gravity_share - 1.0; }

  void judge_calibration() {
    if (!e_.calibrated) {
      say("uncalibrated", "the strokes were recorded without a calibration");
      return;
    }
    for (const std::string& kind : e_.calibrations_invalid) {
      say("calibration_invalid", fmt::format("the calibration of {} was invalid when it was made", kind),
          fmt::format("repeat `asperity calibrate {}`", kind));
    }
    if (e_.calibrations_unstated.empty()) return;
    std::string kinds;
    for (const std::string& kind : e_.calibrations_unstated) kinds += (kinds.empty() ? "" : ", ") + kind;
    say("calibration_unstated", "the calibration does not state where it comes from: " + kinds);
  }

  void judge_strokes() {
    for (const RigEvidence::Stroke& stroke : e_.strokes) {
      const std::string name = printable(stroke.name, 200);
      if (!stroke.measured) say("stroke_not_measured", name + " gave no profile: " + stroke.why_not);
      append_verdicts(out_, stroke.verdicts, name);
    }
    const auto wanted = static_cast<std::size_t>(limits_.strokes);
    if (e_.measured >= wanted) return;
    say("few_strokes", fmt::format("{} stroke{} of {}: repeatability is {}", e_.measured, e_.measured == 1 ? "" : "s",
                                   wanted, e_.measured < 2 ? "not known" : "hardly known"));
  }

  void judge_streams() {
    if (e_.lost_share > limits_.lost) {
      say("rig_rows_lost", fmt::format("a stroke loses {:.1f} % of its rows on average", 100.0 * e_.lost_share));
    }
    if (e_.outlying_share > limits_.outlying) {
      say("rig_poses_outlying",
          fmt::format("{:.1f} % of the poses disagree with the probe", 100.0 * e_.outlying_share));
    }
    if (e_.noise_ratio > limits_.noise) {
      say("rig_tracker_noise", fmt::format("the tracker's noise is {:.2g} times the calibrated", e_.noise_ratio));
    }
  }

  void judge_repeatability() {
    if (pitch_scatter() > limits_.pitch_repeatability) {
      say("pitch_scatters",
          fmt::format("the pitch differs from stroke to stroke by {:.2f} %", 100.0 * pitch_scatter()));
    }
    if (e_.along_rms_m > limits_.along_m) {
      say("length_wanders", fmt::format("the length along the grating wanders by {:.0f} µm RMS", 1e6 * e_.along_rms_m));
    }
    const double depth_scatter = e_.depth_deviation_m / e_.depth_m;
    if (depth_scatter > limits_.depth_repeatability) {
      say("depth_scatters", fmt::format("the depth differs from stroke to stroke by {:.1f} %", 100.0 * depth_scatter));
    }
  }

  void judge_pitch() {
    if (!(std::abs(pitch_error()) > limits_.pitch)) return;
    std::string message = fmt::format("the pitch is {:.4f} mm where {:.4f} mm is true ({:+.2f} %)", 1e3 * e_.pitch_m,
                                      1e3 * e_.true_pitch_m, 100.0 * pitch_error());
    const double scale = 1.0 + pitch_error();
    if (pitch_scatter() > limits_.pitch_repeatability || e_.along_rms_m > limits_.along_m) {
      say("pitch_off", std::move(message), "first correct what makes the strokes differ");
    } else {
      say("pitch_off", std::move(message),
          fmt::format("measure a printed tag: its black border should be {:.4f} of the size that was given; otherwise "
                      "repeat `asperity calibrate camera`, and measure the grating over twenty periods",
                      1.0 / scale));
    }
  }

  void judge_gravity() {
    if (e_.strokes_at_rest == 0) say("gravity_unchecked", "the probe is never stationary: gravity is not checked");
    if (std::abs(gravity_error()) > limits_.gravity) {
      say("gravity_off",
          fmt::format("the stationary accelerometer differs from gravity by {:+.1f} %", 100.0 * gravity_error()));
    }
    if (e_.gravity_angle_rad > limits_.gravity_angle_rad) {
      say("gravity_tilted",
          fmt::format("the up direction of the stationary accelerometer is {:.1f} degrees from the world's",
                      e_.gravity_angle_rad / kDegree_rad));
    }
  }

  void judge_depth() {
    if (e_.measured > 0 && !std::isfinite(depth_error())) {
      say("depth_off", "the depth of the grating could not be measured");
      return;
    }
    if (!(std::abs(depth_error()) > limits_.depth)) return;
    std::string message = fmt::format("the depth is {:.1f} µm where {:.1f} µm is true ({:+.1f} %)", 1e6 * e_.depth_m,
                                      1e6 * e_.true_depth_m, 100.0 * depth_error());
    if (std::abs(gravity_error()) > limits_.gravity && gravity_error() * depth_error() > 0.0) {
      say("depth_off", std::move(message),
          "repeat `asperity calibrate accel`: gravity is wrong in the same sense, which is the accelerometer's scale");
    } else {
      say("depth_off", std::move(message));
    }
  }

  void judge_shape() {
    if (e_.measured > 0 && !std::isfinite(e_.correlation)) {
      say("shape_off", "the profile could not be compared with the sine");
      return;
    }
    if (!(e_.correlation < limits_.correlation)) return;
    const bool alone = is_trustworthy(out_);
    std::string message = fmt::format("the profile is not the sine: correlation {:.3f}, {:.1f} µm RMS from it",
                                      e_.correlation, 1e6 * e_.shape_rms_m);
    if (alone) {
      say("shape_off", std::move(message));
    } else {
      say("shape_off", std::move(message), "first correct what else is invalid");
    }
  }

  void judge_latency() {
    const double sure_s = std::abs(e_.latency_s) - (e_.measured > 1 ? e_.latency_half_width_s : 0.0);
    if (sure_s > limits_.latency_s && sure_s > limits_.latency_sigmas * e_.calibrated_latency_sigma_s) {
      say("latency_off",
          fmt::format("the tracker's latency is {:+.1f} ms from the calibrated one ({:.1f} ± {:.1f} ms)",
                      1e3 * e_.latency_s, 1e3 * e_.calibrated_latency_s, 1e3 * e_.calibrated_latency_sigma_s));
    }
    if (e_.latency_deviation_s > limits_.latency_repeatability_s) {
      say("latency_scatters", fmt::format("the tracker's latency differs from stroke to stroke by {:.1f} ms",
                                          1e3 * e_.latency_deviation_s));
    }
  }

  const RigEvidence& e_;
  const RigLimits& limits_;
  Verdicts out_;
};

}  // namespace

Verdicts judge_rig(const RigEvidence& evidence, const RigLimits& limits) { return RigJudge(evidence, limits).judge(); }

}  // namespace asperity
