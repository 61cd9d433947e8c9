#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "arrow_system.h"
#include "asperity/calibration/calibrate_imu.h"
#include "latency_input.h"
#include "uniform_basis.h"

namespace asperity {

// What calibrate_imu seeks beside the motion. The gyroscope's are left out where there is none.
struct ImuParameters {
  Eigen::Quaterniond R_marker_sensor = Eigen::Quaterniond::Identity();
  Eigen::Vector3d accelerometer_in_marker_m = Eigen::Vector3d::Zero();
  double latency_s = 0.0;
  Eigen::Vector3d accel_bias_mps2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d gravity_world_mps2 = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gyro_matrix = Eigen::Matrix3d::Identity();
  Eigen::Vector3d gyro_bias_radps = Eigen::Vector3d::Zero();

  // Places in the vector of parameters; of the rotation about the marker's axes, of the matrix by columns.
  static constexpr Eigen::Index kRotation = 0, kPosition = 3, kLatency = 6, kBias = 7, kGravity = 10, kGyroBias = 13,
                                kGyroMatrix = 16, kWithoutGyro = 13, kWithGyro = 25;
};

// The motion: the accelerometer's position in the world and the marker's rotation R₀ exp(φ), both splines.
class ImuMotion {
 public:
  // A motion over [first_s, last_s] near the poses, whose times are taken to be late by the parameters' latency.
  ImuMotion(double first_s, double last_s, double knot_s, const PoseSeries& poses, const ImuParameters& start);

  struct State {
    Eigen::Index first_point = 0;
    QuinticBasis basis;  // derivatives by s
    Eigen::Vector3d s_m, v_mps, a_mps2;
    Eigen::Vector3d phi, phi_rate;
    Eigen::Matrix3d R;               // world ← marker
    Eigen::Matrix3d right_jacobian;  // of exp at phi: a change δφ turns R by exp(J_r δφ) from the right
    Eigen::Vector3d omega_radps;     // in the marker frame
    Eigen::Matrix3d omega_by_phi;    // with phi_rate held
  };
  State at(double t_s) const;
  bool covers(double t_s) const { return t_s >= first_s_ && t_s <= last_s_; }

  Eigen::Index points() const { return points_.cols(); }
  double knot_s() const { return knot_s_; }
  // The second derivatives in the middle of the interval that begins with a point, and the points' share in them.
  struct Bend {
    double t_s = 0.0;
    std::array<double, 6> second;
    Eigen::Vector3d a_mps2, phi_second;
  };
  Bend bend(Eigen::Index first_point) const;
  // Moves the control points, s above φ of one after another.
  void step(const Eigen::VectorXd& delta);

 private:
  double first_s_, last_s_, knot_s_;
  Eigen::Quaterniond R0_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> points_;  // s above phi
};

}  // namespace asperity
