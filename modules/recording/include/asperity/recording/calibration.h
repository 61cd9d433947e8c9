#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/json/json.h"
#include "asperity/recording/tag_frame.h"
#include "asperity/recording/tracker_noise_model.h"

namespace asperity {

enum class AccelerometerModel { kScalarOffset, kLinear, kQuadric };

// counts = B φ(f) + C with the specific force f = a − g in the marker frame, m/s² (thesis §3.5,
// errata 4–6). φ(f) = f, and for the quadric model (x, y, z, x², y², z², xy, xz, yz).
struct AccelerometerCalibration {
  AccelerometerModel model = AccelerometerModel::kLinear;
  Eigen::Matrix<double, 3, Eigen::Dynamic> B;  // 3×3, or 3×9 for quadric; counts per m/s² (per (m/s²)²)
  Eigen::Vector3d C = Eigen::Vector3d::Zero();
  Eigen::Vector3d residual_counts = Eigen::Vector3d::Zero();  // standard deviation of the fit
  Eigen::Matrix<double, 3, Eigen::Dynamic> standard_errors;   // 3×(k+1), B's columns then C's; may be empty
  bool rotation_known = true;                           // false: the sensor's rotation to the marker is to be estimated
  std::optional<Eigen::Vector3d> position_in_marker_m;  // nullopt: at the tip
  double position_sigma_m = 0.0;    // extra.accelerometer_position_sigma_m: > 0, estimate the position too
  double rotation_sigma_rad = 0.0;  // extra.accelerometer_rotation_sigma_rad: > 0, refine the rotation to the marker

  Eigen::Vector3d counts(const Eigen::Vector3d& specific_force_mps2) const;
  // Inverts the model; Newton's method for the quadric one. Throws Error if the linear part is singular.
  Eigen::Vector3d specific_force_mps2(const Eigen::Vector3d& counts) const;
};

// counts = B ω + C, ω in the marker frame, rad/s.
struct GyroscopeCalibration {
  Eigen::Matrix3d B = Eigen::Matrix3d::Identity();
  Eigen::Vector3d C = Eigen::Vector3d::Zero();
};

struct ForceCalibration {
  double newton_per_count = 1.0;
  double offset_newton = 0.0;
  double residual_newton = 0.0;
  std::optional<Eigen::Vector3d> axis_in_marker;  // nullopt: from the tip to the marker's origin

  double force_N(double counts) const { return newton_per_count * counts + offset_newton; }
};

// counts = B F + C, F the force on the tip in the marker frame, N: a sensor of three axes (force_x, force_y, force_z).
struct Force3Calibration {
  Eigen::Matrix3d B = Eigen::Matrix3d::Identity();
  Eigen::Vector3d C = Eigen::Vector3d::Zero();
  Eigen::Vector3d residual_newton = Eigen::Vector3d::Zero();  // standard deviation of a reading

  // Throws Error if B is singular.
  Eigen::Vector3d force_N(const Eigen::Vector3d& counts) const;
};

struct TrackerCalibration {
  Eigen::Vector3d sigma_position_m{0.15e-3, 0.13e-3, 0.54e-3};  // along the world's axes (thesis Fig. 9)
  Eigen::Vector3d sigma_rotation_rad{3.5e-3, 3.5e-3, 3.5e-3};
  double latency_s = 0.0;  // the pose's true time is t_ns minus this
  double latency_sigma_s = 0.0;
  std::optional<TrackerNoiseModel> noise_model;  // extra.tracker_noise_model
  // Drift in addition to the white noise, along the world's axes: extra.tracker_slow_sigma_m, and its time constant:
  // extra.tracker_slow_time_s.
  std::optional<Eigen::Vector3d> slow_sigma_m;
  std::optional<double> slow_time_s;
};

struct CameraCalibration {
  int width = 0;
  int height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  // px
  std::vector<double> distortion;                 // k1, k2, p1, p2, k3
  // extra.camera_covariance: of the errors of fx, fy, cx, cy, k1, k2, p1, p2, k3 in this order; nullopt: unknown.
  std::optional<Eigen::Matrix<double, 9, 9>> covariance = std::nullopt;
};

struct MarkerPlacement {
  int id = 0;
  std::string family;
  double size_m = 0.0;
  Pose T_marker_tag;
  std::string body = {};  // empty: the probe's; else the one whose frame T_marker_tag is in (tracked_body.h)
};

// What a calibration of one kind said when it was made.
struct CalibrationRecord {
  std::optional<bool> trustworthy;
  std::optional<std::string> verdict;  // in words
  Json details = Json::object();       // values, standard errors, residuals, settings, version: for a person
};

struct Calibration {
  AccelerometerCalibration accelerometer;
  std::optional<GyroscopeCalibration> gyroscope;
  ForceCalibration force;
  std::optional<Force3Calibration> force3;  // extra.force3
  Eigen::Vector3d tip_in_marker_m = Eigen::Vector3d::Zero();
  double tip_radius_m = 0.00032;
  std::optional<Eigen::Vector3d> tip_sigma_m;  // extra.tip_sigma_m: of tip_in_marker_m, marker axes
  TrackerCalibration tracker;
  double probe_latency_s = 0.0;        // extra.probe_latency_s: a sample's true time is its t_ns minus this
  double probe_latency_sigma_s = 0.0;  // extra.probe_latency_sigma_s
  std::optional<CameraCalibration> camera;
  std::vector<MarkerPlacement> markers;
  std::optional<TagFrame> tag_frame;                    // extra.tag_frame, of `markers` as given; nullopt: ours
  bool uncalibrated = false;                            // extra.uncalibrated: it stands for none (uncalibrated.h)
  std::map<std::string, CalibrationRecord> calibrated;  // extra.calibrated, by kind: camera, tracker, force, accel, …
  Json extra = Json::object();                          // what others have put into extra

  Eigen::Vector3d accelerometer_in_marker_m() const {
    return accelerometer.position_in_marker_m.value_or(tip_in_marker_m);
  }
  // The tip's standard error along the marker's axes, as `calibrate tip` states it
  // (extra.calibrated.tip.stderr.tip_in_marker_m); nullopt: not stated.
  std::optional<Eigen::Vector3d> tip_stderr_m() const;
  // The unit vector of the force sensor's axis in the marker frame, from the tip towards the hand.
  Eigen::Vector3d force_axis_in_marker() const;
};

}  // namespace asperity
