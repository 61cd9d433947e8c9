#include "scan_hint_text.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace asperity {

namespace {

constexpr double kRadian_deg = 180.0 / std::numbers::pi;

}  // namespace

Hint describe_hint(HintKind kind, const ScanHintFacts& facts) {
  const ScanHintsConfig& config = facts.config;
  const double value = facts.value;
  Hint hint;
  hint.kind = kind;
  hint.value = value;
  switch (kind) {
    case HintKind::kNoCalibration:
      hint.severity = HintSeverity::kError;
      hint.text = "This probe has no calibration, so no profile can be shown. Calibrate it, or choose its calibration.";
      break;
    case HintKind::kProbeSilent:
      hint.severity = HintSeverity::kError;
      hint.limit = config.silent_s;
      hint.text =
          fmt::format("The probe has been silent for {:.1f} s. Check its cable and that it is switched on.", value);
      break;
    case HintKind::kRowsLost:
      hint.limit = config.rows_lost_share;
      hint.text = fmt::format(
          "{:.1f} % of the probe's rows are lost. Use another cable or port, or close programs that load this "
          "computer.",
          100.0 * value);
      break;
    case HintKind::kMarkerLost:
      hint.severity = value > config.marker_error_s ? HintSeverity::kError : HintSeverity::kWarning;
      hint.limit = config.marker_lost_s;
      hint.text = fmt::format(
          "The marker has been out of sight for {:.1f} s. Turn it to the camera and keep your hand out of the way.",
          value);
      break;
    case HintKind::kAccelerometerSaturating:
      hint.limit = config.saturated_share;
      hint.text = fmt::format(
          "The accelerometer is at its limit in {:.1f} % of the rows. Scan more slowly or press less.", 100.0 * value);
      break;
    case HintKind::kForceSaturating:
      hint.severity = HintSeverity::kError;
      hint.limit = config.force_headroom;
      hint.text = fmt::format("The force sensor is at {:.0f} % of its range. Press less at once: it can be damaged.",
                              100.0 * value);
      break;
    case HintKind::kTooFast:
      hint.limit = facts.highest_speed_mps;
      hint.text = fmt::format("Too fast for a texture of {:.2g} mm: {:.0f} mm/s. Stay below {:.0f} mm/s.",
                              config.finest_wavelength_mm, 1e3 * value, std::floor(1e3 * facts.highest_speed_mps));
      break;
    case HintKind::kTooLight:
      hint.limit = config.light_N;
      hint.text =
          fmt::format("Too light: {:.2f} N. Press with at least {:.2f} N, so that the tip stays on the surface.", value,
                      config.light_N);
      break;
    case HintKind::kTooHard:
      hint.limit = config.hard_N;
      hint.text = fmt::format("Too hard: {:.1f} N. Press with less than {:.1f} N, to spare the surface and the tip.",
                              value, config.hard_N);
      break;
    case HintKind::kTiltedTooFar:
      hint.limit = config.tilt_deg / kRadian_deg;
      hint.text = fmt::format(
          "The probe is tilted by {:.0f} degrees from the surface's normal. Hold it upright, within {:.0f} degrees.",
          kRadian_deg * value, config.tilt_deg);
      break;
    case HintKind::kTiltingTooFast:
      hint.limit = config.tilt_rate_degps / kRadian_deg;
      hint.text =
          fmt::format("The probe is turning at {:.0f} degrees/s. Keep its angle steady, below {:.0f} degrees/s.",
                      kRadian_deg * value, config.tilt_rate_degps);
      break;
    case HintKind::kDoublingBack:
      hint.limit = config.doubling_back_m;
      hint.text = fmt::format(
          "The path goes back over itself by {:.1f} mm. Scan in one direction; lift the probe or begin a new segment "
          "to "
          "return.",
          1e3 * value);
      break;
  }
  return hint;
}

}  // namespace asperity
