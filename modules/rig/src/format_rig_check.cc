#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "asperity/base/interval_text.h"
#include "asperity/base/nan.h"
#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/rig/check_rig.h"
#include "asperity/verdict/verdict_json.h"

namespace asperity {

namespace {

Json repeated_json(const RepeatedMeasurement& measurement) {
  return {{"count", measurement.count},
          {"mean", number_or_null(measurement.mean)},
          {"standard_deviation", number_or_null(measurement.deviation)},
          {"half_width_95", number_or_null(measurement.half_width)}};
}

Json stroke_json(const RigStroke& stroke, const RigCheck& check) {
  Json out;
  out["name"] = is_utf8(stroke.name) ? stroke.name : printable(stroke.name, 200);
  out["measured"] = stroke.measured;
  if (!stroke.measured) out["why_not"] = stroke.why_not;
  out["trustworthy"] = stroke.measured && is_trustworthy(stroke.verdicts);
  out["verdict"] = verdict_sentence(stroke.verdicts);
  out["verdicts"] = verdicts_json(stroke.verdicts);
  const GratingMetrics& grating = stroke.grating;
  out["pitch_m"] = number_or_null(grating.pitch_m);
  out["pitch_stderr_m"] = number_or_null(grating.pitch_stderr_m);
  out["pitch_from_mean_m"] = number_or_null(grating.pitch_m - check.pitch_m.mean);
  out["depth_m"] = number_or_null(grating.depth_m);
  out["depth_stderr_m"] = number_or_null(grating.depth_stderr_m);
  out["depth_from_mean_m"] = number_or_null(grating.depth_m - check.depth_m.mean);
  out["median_depth_m"] = number_or_null(stroke.median_depth_m);
  out["Rq_m"] = number_or_null(stroke.Rq_m);
  out["shape_rms_m"] = number_or_null(grating.shape_rms_m);
  out["correlation"] = number_or_null(grating.correlation);
  out["along_rms_m"] = number_or_null(grating.along_rms_m);
  out["length_m"] = number_or_null(grating.length_m);
  out["length_error_m"] = number_or_null(grating.length_error_m);
  out["speed_mps"] = number_or_null(stroke.speed_mps);
  out["latency_from_calibrated_s"] = number_or_null(stroke.latency_s);
  out["accel_bias_mps2"] = number_or_null(stroke.accel_bias_mps2);
  out["tracker_noise_ratio"] = number_or_null(stroke.tracker_noise_ratio);
  out["poses_outlying_share"] = number_or_null(stroke.outlying_share);
  out["gravity_share"] = number_or_null(stroke.gravity_share);
  out["gravity_angle_rad"] = number_or_null(stroke.gravity_angle_rad);
  out["inspection"] = inspection_json(stroke.inspection);
  return out;
}

std::string format_row(const char* name, const RepeatedMeasurement& measurement, double scale, const char* unit,
                       double true_value) {
  const bool several = measurement.count > 1;
  const IntervalText mean = interval_parts(scale * measurement.mean, several ? scale * measurement.half_width : kNan);
  std::string out = fmt::format("{:<13} {:>9} ± {:<8} {:<4} each ± {:<8}", name, mean.value, several ? mean.error : "?",
                                unit, several ? rounded_text(scale * measurement.deviation, 2) : "?");
  if (std::isfinite(true_value)) {
    out += fmt::format("true {:.5g} ({:+.2f} %)", scale * true_value, 100.0 * (measurement.mean / true_value - 1.0));
  }
  while (out.ends_with(' ')) out.pop_back();
  return out + "\n";
}

}  // namespace

std::string rig_check_json(const RigCheck& check, const CheckRigConfig& config) {
  Json out;
  out["format"] = "asperity-rig-check";
  out["version"] = 1;
  out["right"] = check.right;
  out["trustworthy"] = check.right;
  out["verdict"] = check.verdict;
  out["verdicts"] = verdicts_json(check.verdicts);
  out["true"] = {
      {"pitch_m", config.grating.pitch_m}, {"depth_m", config.grating.depth_m}, {"traced_Rq_m", check.true_Rq_m}};
  out["pitch_m"] = repeated_json(check.pitch_m);
  out["depth_m"] = repeated_json(check.depth_m);
  out["Rq_m"] = repeated_json(check.Rq_m);
  out["shape_rms_m"] = repeated_json(check.shape_rms_m);
  out["correlation"] = repeated_json(check.correlation);
  out["along_rms_m"] = repeated_json(check.along_rms_m);
  out["latency_from_calibrated_s"] = repeated_json(check.latency_s);
  out["gravity_share"] = repeated_json(check.gravity_share);
  out["gravity_angle_rad"] = repeated_json(check.gravity_angle_rad);
  out["tracker_noise_ratio"] = repeated_json(check.tracker_noise_ratio);
  out["poses_outlying_share"] = repeated_json(check.outlying_share);
  out["lost_share"] = repeated_json(check.lost_share);
  out["strokes"] = Json::array();
  for (const RigStroke& stroke : check.strokes) out["strokes"].push_back(stroke_json(stroke, check));
  CheckRigConfig resolved = config;
  out["config"] = config_json(list_fields("", resolved));
  out["asperity"] = kVersion;
  return out.dump_repaired(2);
}

std::string rig_check_text(const RigCheck& check, const CheckRigConfig& config) {
  std::string out;
  for (const RigStroke& stroke : check.strokes) {
    out += printable(stroke.name, 200) + ": ";
    if (!stroke.measured) {
      out += "no profile: " + stroke.why_not + "\n";
      continue;
    }
    const GratingMetrics& grating = stroke.grating;
    out += fmt::format("pitch {:.4f} ± {:.4f} mm, depth {:.1f} ± {:.1f} µm, {:.0f} mm at {:.0f} mm/s\n",
                       1e3 * grating.pitch_m, 1e3 * grating.pitch_stderr_m, 1e6 * grating.depth_m,
                       1e6 * grating.depth_stderr_m, 1e3 * grating.length_m, 1e3 * stroke.speed_mps);
  }
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (check.pitch_m.count > 0) {
    out += fmt::format("mean of {} ± its 95 % interval, and one stroke's standard deviation:\n", check.pitch_m.count);
    out += format_row("pitch", check.pitch_m, 1e3, "mm", config.grating.pitch_m);
    out += format_row("depth", check.depth_m, 1e6, "µm", config.grating.depth_m);
    out += format_row("Rq", check.Rq_m, 1e6, "µm", check.true_Rq_m);
    out += format_row("shape error", check.shape_rms_m, 1e6, "µm", kUnknown);
    out += format_row("correlation", check.correlation, 1.0, "", kUnknown);
    out += format_row("along", check.along_rms_m, 1e6, "µm", kUnknown);
    out += format_row("latency error", check.latency_s, 1e3, "ms", kUnknown);
    out += format_row("gravity", check.gravity_share, 100.0, "%", kUnknown);
  }
  if (check.verdicts.empty()) out += "valid\n";
  for (const Verdict& verdict : check.verdicts) out += verdict_line(verdict) + "\n";
  return out + (check.right ? "RIGHT\n" : "NOT RIGHT\n");
}

}  // namespace asperity
