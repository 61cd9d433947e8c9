#include "judge_rig.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

// What is wrong with a rig, one fault after another; a figure that is nan is no fault.
class RigJudge {
 public:
  RigJudge(std::span<const NamedRecording> strokes, const CheckRigConfig& config, RigCheck& check)
      : strokes_(strokes), limits_(config.limits), config_(config), check_(check) {
    pitch_share_ = check.pitch_m.mean / config.grating.pitch_m - 1.0;
    depth_share_ = check.depth_m.mean / config.grating.depth_m - 1.0;
    gravity_share_ = check.gravity_share.mean - 1.0;
    pitch_scatter_ = check.pitch_m.deviation / check.pitch_m.mean;
    depth_scatter_ = check.depth_m.deviation / check.depth_m.mean;
  }

  void judge() {
    judge_calibration();
    judge_strokes();
    judge_streams();
    judge_scatter();
    judge_pitch();
    judge_rest();
    judge_depth();
    judge_shape();
    judge_latency();
    conclude();
  }

 private:
  void fault(std::string kind, std::string what, std::string cause) {
    check_.faults.push_back({std::move(kind), std::move(what), std::move(cause)});
  }
  bool loose() const {
    return pitch_scatter_ > limits_.pitch_repeatability || check_.along_rms_m.mean > limits_.along_m;
  }

  void judge_calibration() {
    const Calibration& calibration = strokes_.front().recording.calibration;
    if (calibration.uncalibrated) {
      fault("calibration", "The strokes were recorded without a calibration.",
            "Calibrate first: accel, tip, force, camera, tracker, latency.");
      return;
    }
    std::string missing;
    for (const char* kind : {"camera", "tracker", "force", "accel", "tip", "latency"}) {
      const auto found = calibration.calibrated.find(kind);
      if (found == calibration.calibrated.end()) {
        missing += (missing.empty() ? "" : ", ") + std::string(kind);
        continue;
      }
      if (found->second.trustworthy == false) {
        fault("calibration", fmt::format("The calibration of {} was invalid when it was made.", kind),
              fmt::format("Repeat asperity calibrate {}.", kind));
      }
    }
    if (!missing.empty()) check_.remarks.push_back("the calibration does not say where it comes from: " + missing);
  }

  void judge_strokes() {
    for (const RigStroke& stroke : check_.strokes) {
      if (!stroke.measured) {
        fault("stroke", fmt::format("{} gave no profile: {}", printable(stroke.name, 200), stroke.why_not),
              "Scan again, slowly and straight across the ridges, from land to land.");
      } else if (!stroke.trustworthy) {
        fault("stroke", fmt::format("{}: {}.", printable(stroke.name, 200), stroke.verdict), "That sentence names it.");
      }
    }
    const auto wanted = static_cast<std::size_t>(limits_.strokes);
    if (check_.pitch_m.count < wanted) {
      check_.remarks.push_back(fmt::format("{} strokes of {}: repeatability is {}", check_.pitch_m.count, wanted,
                                           check_.pitch_m.count < 2 ? "not known" : "hardly known"));
    }
  }

  void judge_streams() {
    if (check_.lost_share.mean > limits_.lost) {
      fault("lost", fmt::format("A stroke loses {:.1f} % of its rows on the average.", 100.0 * check_.lost_share.mean),
            "The link, its cable or Wi-Fi, or tags out of view: asperity inspect names the stream.");
    }
    if (check_.outlying_share.mean > limits_.outlying) {
      fault("outlying",
            fmt::format("{:.1f} % of the poses disagree with the probe.", 100.0 * check_.outlying_share.mean),
            "Tags seen badly (light, blur, distance, one tag alone), or a loose marker.");
    }
    if (check_.median_noise_ratio > limits_.noise) {
      fault("noise", fmt::format("The tracker's noise is {:.2g} times the calibrated.", check_.median_noise_ratio),
            "A loose marker, another distance or light than when it was calibrated: asperity calibrate tracker.");
    }
  }

  void judge_scatter() {
    const std::string cause =
        "The tip's place in the marker's frame is wrong (asperity calibrate tip), the marker or the tip is loose, or "
        "the "
        "grating moved.";
    if (pitch_scatter_ > limits_.pitch_repeatability) {
      fault("pitch_repeatability",
            fmt::format("The pitch differs from stroke to stroke by {:.2f} %.", 100.0 * pitch_scatter_), cause);
    }
    if (check_.along_rms_m.mean > limits_.along_m) {
      fault("along", fmt::format("The way along the grating wanders by {:.0f} µm RMS.", 1e6 * check_.along_rms_m.mean),
            cause);
    }
    if (depth_scatter_ > limits_.depth_repeatability) {
      fault(
          "depth_repeatability",
          fmt::format("The depth differs from stroke to stroke by {:.1f} %.", 100.0 * depth_scatter_),
          "The tip leaves the surface (press more, go slower), the accelerometer is loose, or the valleys are dirty.");
    }
  }

  void judge_pitch() {
    if (!(std::abs(pitch_share_) > limits_.pitch)) return;
    const double scale = 1.0 + pitch_share_;
    const std::string cause =
        loose() ? "First mend what makes the strokes differ."
                : fmt::format(
                      "The tracker's lengths are wrong by the factor {:.4f}. Measure a printed tag: its black "
                      "border should be {:.4f} of the size that was told; if it is as told, the camera's focal "
                      "length is wrong (asperity calibrate camera). Measure the grating over twenty periods too.",
                      scale, 1.0 / scale);
    fault("pitch",
          fmt::format("The pitch is {:.4f} mm where {:.4f} mm is true ({:+.2f} %).", 1e3 * check_.pitch_m.mean,
                      1e3 * config_.grating.pitch_m, 100.0 * pitch_share_),
          cause);
  }

  void judge_rest() {
    if (check_.gravity_share.count == 0) check_.remarks.emplace_back("the probe never rests: gravity is not checked");
    if (std::abs(gravity_share_) > limits_.gravity) {
      fault("gravity", fmt::format("At rest the accelerometer is {:+.1f} % off gravity.", 100.0 * gravity_share_),
            "The accelerometer's scale or offset: asperity calibrate accel.");
    }
    if (check_.median_gravity_angle_rad > limits_.gravity_angle_rad) {
      fault("gravity_angle",
            fmt::format("At rest the accelerometer's up is {:.1f}° from the world's.",
                        check_.median_gravity_angle_rad / kDegree_rad),
            "The marker is loose or has turned on the probe, the camera was moved since gravity was told, or the "
            "accelerometer's rotation is wrong (asperity calibrate accel).");
    }
  }

  void judge_depth() {
    if (!(std::abs(depth_share_) > limits_.depth)) return;
    const bool accelerometer = std::abs(gravity_share_) > limits_.gravity && gravity_share_ * depth_share_ > 0.0;
    fault("depth",
          fmt::format("The depth is {:.1f} µm where {:.1f} µm is true ({:+.1f} %).", 1e6 * check_.depth_m.mean,
                      1e6 * config_.grating.depth_m, 100.0 * depth_share_),
          accelerometer ? "The accelerometer's scale, for gravity is wrong in the same sense: asperity calibrate accel."
                        : "Gravity does not show the accelerometer's scale to be wrong: a worn or other tip than the "
                          "calibration says, a print of another depth (measure it), a tip that leaves the surface, or "
                          "an accelerometer that is not rigidly joined to the tip.");
  }

  void judge_shape() {
    if (!(check_.correlation.mean < limits_.correlation)) return;
    fault("shape",
          fmt::format("The profile is not the sine: correlation {:.3f}, {:.1f} µm RMS beside it.",
                      check_.correlation.mean, 1e6 * check_.shape_rms_m.mean),
          check_.faults.empty() ? "A rough print, dirt, a worn tip, or a tip that leaves the surface."
                                : "Mostly what else is wrong.");
  }

  void judge_latency() {
    const TrackerCalibration& tracker = strokes_.front().recording.calibration.tracker;
    const RepeatedMeasurement& latency = check_.latency_s;
    const double sure_s = std::abs(latency.mean) - (latency.count > 1 ? latency.half_width : 0.0);
    if (sure_s > limits_.latency_s && sure_s > limits_.latency_sigmas * tracker.latency_sigma_s) {
      fault("latency",
            fmt::format("The tracker comes {:.1f} ms later than calibrated ({:.1f} ± {:.1f} ms).", 1e3 * latency.mean,
                        1e3 * tracker.latency_s, 1e3 * tracker.latency_sigma_s),
            "Camera settings or host changed since: asperity calibrate latency.");
    }
    if (latency.deviation > limits_.latency_repeatability_s) {
      fault("latency_repeatability",
            fmt::format("The tracker's latency differs from stroke to stroke by {:.1f} ms.", 1e3 * latency.deviation),
            "A loose marker, or a host that is too busy to stamp images and samples evenly.");
    }
  }

  void conclude() {
    check_.right = check_.faults.empty() && check_.pitch_m.count > 0;
    if (check_.right) {
      check_.verdict = "the rig is right";
    } else {
      check_.verdict = "the rig is not right:";
      for (const RigFault& fault : check_.faults) check_.verdict += " " + fault.what;
    }
    if (check_.pitch_m.count < static_cast<std::size_t>(limits_.strokes)) {
      check_.verdict +=
          fmt::format("{} as far as {} can tell", check_.right ? "," : " That is",
                      check_.pitch_m.count == 1 ? "one stroke" : fmt::format("{} strokes", check_.pitch_m.count));
    }
  }

  std::span<const NamedRecording> strokes_;
  const RigLimits& limits_;
  const CheckRigConfig& config_;
  RigCheck& check_;
  double pitch_share_, depth_share_, gravity_share_, pitch_scatter_, depth_scatter_;
};

}  // namespace

void judge_rig(std::span<const NamedRecording> strokes, const CheckRigConfig& config, RigCheck& check) {
  RigJudge(strokes, config, check).judge();
}

}  // namespace asperity
