#pragma once

#include <vector>

#include "latency_input.h"
#include "latency_model.h"
#include "pose_interpolator.h"

namespace asperity {

// The accelerometer's place predicted from its twice integrated signal, turned into the world by the tracker's own
// rotations. Parameters: latency; bias (3, m/s², marker frame); an error of the world's gravity (3); the sensor's
// rotation (3), free where it is to be solved, otherwise within its standard error; what the calibrations of the
// accelerometer's scales and angles (6, a symmetric E) and of its place (3) are wrong by, within their standard errors:
// f_marker = (1 + E) R_marker_sensor f_sensor − bias.
class AccelerationModel : public LatencyModel {
 public:
  AccelerationModel(const SensorSeries& sensor, const PoseSeries& poses, const PoseInterpolator& tracker,
                    const Eigen::Vector3d& lever_arm_m, const Eigen::Vector3d& gravity_world_mps2, bool solve_rotation,
                    double lever_sigma_m);

  double latency_s = 0.0;
  Eigen::Vector3d bias_mps2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d gravity_world_mps2;
  Eigen::Quaterniond R_marker_sensor = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d matrix_error = Eigen::Matrix3d::Zero();
  Eigen::Vector3d lever_error_m = Eigen::Vector3d::Zero();

  DriftKind drift() const override { return DriftKind::kIntegratedRandomWalk; }
  const std::vector<double>& pose_t_s() const override { return poses_.t_s; }
  const std::vector<std::uint8_t>& starts() const override { return poses_.starts; }
  int parameters() const override { return 19; }
  LatencyRows rows() const override;
  double least_drift_rate() const override { return least_drift_rate_; }
  void step(const Eigen::VectorXd& delta) override;
  Eigen::VectorXd prior_sigma() const override;
  Eigen::VectorXd from_prior() const override;

 private:
  // The residuals at a latency, and, if asked, the slopes but the first column.
  Eigen::VectorXd residuals(double latency, Eigen::MatrixXd* slopes) const;

  const SensorSeries& sensor_;
  const PoseSeries& poses_;
  const PoseInterpolator& tracker_;
  Eigen::Vector3d lever_arm_m_;
  Eigen::Vector3d stated_gravity_mps2_;
  bool solve_rotation_;
  double lever_sigma_m_;
  double least_drift_rate_;
};

}  // namespace asperity
