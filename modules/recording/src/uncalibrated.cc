#include "asperity/recording/uncalibrated.h"

namespace asperity {

namespace {

double or_one(double scale) { return scale > 0.0 ? scale : 1.0; }

}  // namespace

Calibration make_uncalibrated(double accel_counts_per_mps2, double gyro_counts_per_radps, double newton_per_count) {
  Calibration out;
  out.accelerometer.B = or_one(accel_counts_per_mps2) * Eigen::Matrix3d::Identity();
  out.accelerometer.rotation_known = false;
  if (gyro_counts_per_radps > 0.0) {
    out.gyroscope.emplace();
    out.gyroscope->B = gyro_counts_per_radps * Eigen::Matrix3d::Identity();
  }
  out.force.newton_per_count = or_one(newton_per_count);
  out.force.axis_in_marker = Eigen::Vector3d::UnitZ();
  out.uncalibrated = true;
  return out;
}

}  // namespace asperity
