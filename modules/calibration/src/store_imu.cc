#include "asperity/calibration/store_imu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asperity/geometry/pose.h"

namespace asperity {

namespace {

constexpr double kSure = 4.0;  // standard errors

bool is_off(const ImuCalibration& imu) {
  const Eigen::Vector3d turn = log_rotation(imu.R_marker_sensor);
  return (turn.cwiseAbs().array() > kSure * imu.rotation_error_rad.array()).any();
}

bool takes_rotation(const ImuCalibration& imu, const Calibration& used) {
  if (used.accelerometer.model == AccelerometerModel::kQuadric) return false;
  return !used.accelerometer.rotation_known || is_off(imu);
}

}  // namespace

void store_imu(const ImuCalibration& imu, const Calibration& used, Calibration& calibration) {
  AccelerometerCalibration& accelerometer = calibration.accelerometer;
  if (takes_rotation(imu, used)) {
    // counts = B f_sensor + C and f_sensor = Mᵀ f_marker.
    const Eigen::Matrix3d B = used.accelerometer.B.leftCols<3>();
    accelerometer = used.accelerometer;
    accelerometer.B = B * imu.R_marker_sensor.conjugate().toRotationMatrix();
    accelerometer.standard_errors.resize(3, 0);  // those of B's own frame no longer hold
    accelerometer.rotation_known = true;
    accelerometer.rotation_sigma_rad = imu.rotation_error_rad.maxCoeff();
  }
  accelerometer.position_in_marker_m = imu.accelerometer_in_marker_m;
  accelerometer.position_sigma_m = std::sqrt(imu.position_covariance_m2.trace() / 3.0);
  calibration.tracker.latency_s = imu.latency_s;
  calibration.tracker.latency_sigma_s = imu.latency_error_s;
  if (imu.has_gyro && (!used.gyroscope || takes_rotation(imu, used))) {
    const GyroscopeCalibration sensor = used.gyroscope.value_or(GyroscopeCalibration{});
    calibration.gyroscope = GyroscopeCalibration{sensor.B * imu.gyro_matrix, sensor.C + sensor.B * imu.gyro_bias_radps};
  }
}

std::string imu_storage_text(const ImuCalibration& imu, const Calibration& used) {
  if (used.accelerometer.model == AccelerometerModel::kQuadric) {
    return "the accelerometer's model is quadric: its rotation stays as it was calibrated";
  }
  if (!used.accelerometer.rotation_known) return "the sensor's rotation is written to its calibration";
  const double turn_rad = log_rotation(imu.R_marker_sensor).norm();
  if (is_off(imu)) {
    return fmt::format("the sensor is rotated by {:.1f} mrad from its calibration, which was corrected",
                       1e3 * turn_rad);
  }
  return fmt::format("the sensor's rotation agrees with its calibration, which is kept (it differs by {:.1f} mrad)",
                     1e3 * turn_rad);
}

}  // namespace asperity
