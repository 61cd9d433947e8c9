#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/base/problem.h"
#include "asperity/calibration/calibration_verdict.h"
#include "asperity/recording/recording.h"

namespace asperity {

struct ImuConfig {
  double knot_s = 0.01;
  double fastest_Hz = 500.0;
  double largest_gap_s = 0.05;
  double least_latency_s = -0.1;
  double largest_latency_s = 0.4;
  int least_poses = 100;
  double largest_position_error_m = 0.01;
  double good_position_error_m = 0.001;
  double good_rotation_error_rad = 0.01;
  double good_latency_error_s = 0.0005;
  double gravity_sigma_mps2 = 0.05;
  double outlier_sigmas = 6.0;

  template <class V>
  void visit(V& v) {
    v.field("knot_s", knot_s, "between two knots of the spline, s", {0.001, 0.1});
    v.field("fastest_Hz", fastest_Hz, "samples that come faster are averaged to at most this rate, Hz", {50.0, 1e5});
    v.field("largest_gap_s", largest_gap_s, "a longer hole in the probe's samples ends the motion that is used, s",
            {1e-3, 10.0});
    v.field("least_latency_s", least_latency_s, "the latency is sought from here, s", {-10.0, 10.0});
    v.field("largest_latency_s", largest_latency_s, "to here, s", {-10.0, 10.0});
    v.field("least_poses", least_poses, "poses that are needed", {20, 1000000});
    v.field("largest_position_error_m", largest_position_error_m,
            "standard error of the accelerometer's place above which the motion is refused, m", {0.0, 10.0});
    v.field("good_position_error_m", good_position_error_m, "and above which the verdict warns, m", {0.0, 10.0});
    v.field("good_rotation_error_rad", good_rotation_error_rad,
            "standard error of the rotation above which the verdict warns, rad", {0.0, 1.0});
    v.field("good_latency_error_s", good_latency_error_s,
            "standard error of the latency above which the verdict warns, s", {0.0, 1.0});
    v.field("gravity_sigma_mps2", gravity_sigma_mps2, "of the recording's gravity along each axis, m/s2", {0.0, 1.0});
    v.field("outlier_sigmas", outlier_sigmas, "poses further off the spline are left out", {4.0, 1e6});
  }
};

// Where the inertial sensor is on the probe and when it speaks.
struct ImuCalibration {
  Eigen::Vector3d accelerometer_in_marker_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_error_m = Eigen::Vector3d::Zero();  // standard errors along the marker's axes
  Eigen::Matrix3d position_covariance_m2 = Eigen::Matrix3d::Zero();
  // Marker ← the frame in which the calibration gives the specific force; identity where that is the marker's own.
  Eigen::Quaterniond R_marker_sensor = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rotation_error_rad = Eigen::Vector3d::Zero();  // about the marker's axes
  double latency_s = 0.0;  // a pose's true time on the probe's samples' clock is its t_ns minus this
  double latency_error_s = 0.0;
  Eigen::Vector3d accel_bias_mps2 = Eigen::Vector3d::Zero();  // in the sensor's frame
  Eigen::Vector3d accel_bias_error_mps2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d gravity_world_mps2 = Eigen::Vector3d::Zero();
  // ω as the calibration gives it (counts where there is none) = matrix · ω in the marker frame + bias.
  bool has_gyro = false;
  Eigen::Matrix3d gyro_matrix = Eigen::Matrix3d::Identity();
  Eigen::Vector3d gyro_bias_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro_bias_error_radps = Eigen::Vector3d::Zero();

  Eigen::Vector3d pose_noise_m = Eigen::Vector3d::Zero();    // of a pose, along the world's axes
  Eigen::Vector3d pose_noise_rad = Eigen::Vector3d::Zero();  // and about them
  double accel_noise_mps2 = 0.0;                             // of a sample as it was used
  double gyro_noise_radps = 0.0;
  double dispersion = 1.0;    // variance of the calibration by seconds of the recording over that of independent errors
  double turn_rms_rad = 0.0;  // RMS rotation of the probe about its mean
  Eigen::Vector3d worst_direction = Eigen::Vector3d::UnitZ();  // in the marker frame: the least certain direction
  double duration_s = 0.0;
  std::size_t poses = 0;
  Problems problems;
  CalibrationVerdict verdict;
};

// The inertial sensor against the marker body from a free motion in the air, as Kalibr does it (Furgale, Rehder and
// Siegwart, 2013): least squares over a continuous motion, the accelerometer's position s(t) and the marker's rotation
// R(t) = R₀ exp(φ(t)), uniform B-splines of the fifth degree, with what is sought,
//   pose:          p_i = s(t_i − δ) − R ρ,   R_i = R(t_i − δ)
//   accelerometer: f = Mᵀ Rᵀ (s″ − g) + b_a
//   gyroscope:     ω = E J_r(φ) φ′ + b_g,
// with the latency δ, the accelerometer's place ρ, its rotation M, biases, the gyroscope's matrix E, and gravity within
// gravity_sigma_mps2. Each kind of measurement has the noise that its own residuals show; standard errors are those of
// the information matrix, larger where the seconds of the recording disagree (docs/calibration.md). Poses more than
// outlier_sigmas off are left out. Throws Error, saying what to record instead, for too few poses, a probe that rotated
// by more than two radians from its mean, or motion that does not determine the position.
ImuCalibration calibrate_imu(const Recording& recording, const ImuConfig& config = {});

}  // namespace asperity
