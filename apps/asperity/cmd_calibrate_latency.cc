#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>

#include "asperity/calibration/calibrate_latency.h"
#include "asperity/recording/read_recording.h"
#include "calibrate_command.h"
#include "commands.h"

namespace asperity::app {

namespace {

Json quaternion_json(const Eigen::Quaterniond& q) { return json_of(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())); }

// The gyroscope's calibration with what the fit found: ω_marker = scale R ω_sensor − bias.
GyroscopeCalibration turned(const GyroscopeCalibration& sensor, const LatencyFit& fit) {
  GyroscopeCalibration out;
  out.B = sensor.B * fit.R_marker_sensor.conjugate().toRotationMatrix() / fit.scale;
  out.C = sensor.C + out.B * fit.bias;
  return out;
}

class CalibrateLatencyCommand : public CalibrateCommand {
 public:
  explicit CalibrateLatencyCommand(Parser& calibrate)
      : CalibrateCommand(calibrate, "latency", "The tracker's latency against the probe, from a recording of shaking") {
    require(parser().add_option("REC", folder_, "A recording in which the probe is shaken in front of the camera"));
    parser()
        .add_option("--calibration", calibration_, "Used instead of the recording's own calibration")
        ->type_name("calibration.json");
  }

  std::vector<ConfigField> fields() override { return list_fields("calibration", config_); }

 private:
  std::vector<std::string> inputs() const override { return {folder_}; }

  CalibrateOutcome calibrate(const Observer& observer) override {
    Recording recording = read_recording(folder_, {}, observer);
    if (!calibration_.empty()) recording.calibration = read_calibration(calibration_, {}, observer);
    observer.update("fitting", 0.5);
    return describe(calibrate_latency(recording, config_), recording);
  }

  static CalibrateOutcome describe(const LatencyFit& fit, const Recording& recording) {
    CalibrateOutcome out;
    out.values = {{"latency_s", fit.latency_s}, {"clock_rate", fit.clock_rate}};
    out.standard_errors = {{"latency_s", fit.latency_error_s}, {"clock_rate", fit.clock_rate_error}};
    const std::string bias_key = fit.by_gyroscope ? "bias_radps" : "bias_mps2";
    out.values[bias_key] = json_of(fit.bias);
    out.standard_errors[bias_key] = json_of(fit.bias_error);
    if (fit.rotation_solved) {
      out.values["rotation_marker_sensor"] = quaternion_json(fit.R_marker_sensor);
      out.details["rotation_stderr_rad"] = json_of(fit.rotation_error_rad);
    }
    if (fit.scale_solved) {
      out.values["radps_per_count"] = fit.scale;
      out.standard_errors["radps_per_count"] = fit.scale_error;
    }
    out.residuals = {{fit.by_gyroscope ? "pose_noise_rad" : "pose_noise_m", json_of(fit.residual)},
                     {fit.by_gyroscope ? "drift_rad_per_sqrt_s" : "drift_mps_per_sqrt_s", json_of(fit.drift)},
                     {"poses", fit.poses}};
    out.details["sensor"] = fit.by_gyroscope ? "gyroscope" : "accelerometer";
    out.details[fit.by_gyroscope ? "motion_radps" : "motion_mps2"] = fit.motion;
    if (std::isfinite(fit.runner_up_s)) {
      out.details["runner_up"] = {{"latency_s", fit.runner_up_s}, {"sum_of_squares_ratio", fit.runner_up_ratio}};
    }
    Json scan = Json::array();
    for (std::size_t i = 0; i < fit.scan_cost.size(); ++i) scan.push_back({fit.scan_latency_s[i], fit.scan_cost[i]});
    out.details["scan"] = scan;  // latency in s, share of the motion that it does not explain
    constexpr double kMilli = 1e3, kMicro = 1e6;
    out.table = {{"latency", kMilli * fit.latency_s, kMilli * fit.latency_error_s, "ms"},
                 {"clock rate", kMicro * fit.clock_rate, kMicro * fit.clock_rate_error, "ppm"}};
    for (const Problem& problem : fit.problems) out.notes.push_back(problem.message);
    if (recording.calibration.probe_latency_s != 0.0) {
      out.notes.push_back(fmt::format(
          "the probe's own latency of {:.2f} ms, which the calibration states, was subtracted from its times",
          kMilli * recording.calibration.probe_latency_s));
    }
    if (fit.rotation_solved) {
      const Eigen::Quaterniond& q = fit.R_marker_sensor;
      out.notes.push_back(
          fmt::format("the sensor's rotation in the marker frame was estimated too: ({:.5f}, {:.5f}, {:.5f}, {:.5f}), "
                      "to {:.2g} rad{}",
                      q.w(), q.x(), q.y(), q.z(), fit.rotation_error_rad.maxCoeff(),
                      fit.by_gyroscope ? "; it is written to the gyroscope's calibration" : ""));
    }
    out.verdict = fit.verdict;
    const GyroscopeCalibration sensor = recording.calibration.gyroscope.value_or(GyroscopeCalibration{});
    out.store = [fit, sensor](Calibration& calibration) {
      calibration.tracker.latency_s = fit.latency_s;
      calibration.tracker.latency_sigma_s = fit.latency_error_s;
      if (fit.by_gyroscope && fit.rotation_solved) calibration.gyroscope = turned(sensor, fit);
    };
    return out;
  }

  std::string folder_, calibration_;
  LatencyConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_latency(Parser& calibrate) {
  return std::make_unique<CalibrateLatencyCommand>(calibrate);
}

}  // namespace asperity::app
