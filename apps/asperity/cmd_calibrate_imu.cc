#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "asperity/calibration/calibrate_imu.h"
#include "asperity/calibration/store_imu.h"
#include "asperity/recording/read_recording.h"
#include "calibrate_command.h"
#include "commands.h"

namespace asperity::app {

namespace {

class CalibrateImuCommand : public CalibrateCommand {
 public:
  explicit CalibrateImuCommand(Parser& calibrate)
      : CalibrateCommand(calibrate, "imu",
                         "Position and rotation of the accelerometer on the probe and the tracker's latency, from a "
                         "free motion in the air") {
    require(parser().add_option("REC", folder_, "A recording in which the probe is moved and rotated in the air"));
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
    observer.update("fitting", 0.3);
    const ImuCalibration imu = calibrate_imu(recording, config_);
    const Eigen::Quaterniond& q = imu.R_marker_sensor;
    CalibrateOutcome out;
    out.values = {{"accelerometer_position_in_marker_m", json_of(imu.accelerometer_in_marker_m)},
                  {"rotation_marker_sensor_rad", json_of(log_rotation(q))},
                  {"latency_s", imu.latency_s},
                  {"accel_bias_mps2", json_of(imu.accel_bias_mps2)}};
    out.standard_errors = {{"accelerometer_position_in_marker_m", json_of(imu.position_error_m)},
                           {"rotation_marker_sensor_rad", json_of(imu.rotation_error_rad)},
                           {"latency_s", imu.latency_error_s},
                           {"accel_bias_mps2", json_of(imu.accel_bias_error_mps2)}};
    if (imu.has_gyro) {
      out.values["gyro_bias_radps"] = json_of(imu.gyro_bias_radps);
      out.standard_errors["gyro_bias_radps"] = json_of(imu.gyro_bias_error_radps);
      out.details["gyro_matrix"] = json_of_rows(imu.gyro_matrix);
      out.residuals["gyro_noise_radps"] = imu.gyro_noise_radps;
    }
    out.residuals["pose_noise_m"] = json_of(imu.pose_noise_m);
    out.residuals["pose_noise_rad"] = json_of(imu.pose_noise_rad);
    out.residuals["accel_noise_mps2"] = imu.accel_noise_mps2;
    out.residuals["dispersion"] = imu.dispersion;
    out.residuals["poses"] = imu.poses;
    out.details["rotation_marker_sensor"] = json_of(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
    out.details["position_covariance_m2"] = json_of_rows(imu.position_covariance_m2);
    out.details["gravity_world_mps2"] = json_of(imu.gravity_world_mps2);
    out.details["worst_direction"] = json_of(imu.worst_direction);
    out.details["turn_rms_rad"] = imu.turn_rms_rad;
    out.details["duration_s"] = imu.duration_s;
    constexpr double kMilli = 1e3;
    const Eigen::Vector3d turn = log_rotation(q);
    for (int axis = 0; axis < 3; ++axis) {
      out.table.push_back({fmt::format("accelerometer {} in the marker", "xyz"[axis]),
                           kMilli * imu.accelerometer_in_marker_m[axis], kMilli * imu.position_error_m[axis], "mm"});
    }
    for (int axis = 0; axis < 3; ++axis) {
      out.table.push_back({fmt::format("rotation about {}", "xyz"[axis]), kMilli * turn[axis],
                           kMilli * imu.rotation_error_rad[axis], "mrad"});
    }
    out.table.push_back({"latency", kMilli * imu.latency_s, kMilli * imu.latency_error_s, "ms"});
    for (const Problem& problem : imu.problems) out.notes.push_back(problem.message);
    out.notes.emplace_back(imu_storage_text(imu, recording.calibration));
    out.verdict = imu.verdict;
    const Calibration& used = recording.calibration;
    out.store = [imu, used](Calibration& calibration) { store_imu(imu, used, calibration); };
    return out;
  }

  std::string folder_, calibration_;
  ImuConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_imu(Parser& calibrate) {
  return std::make_unique<CalibrateImuCommand>(calibrate);
}

}  // namespace asperity::app
