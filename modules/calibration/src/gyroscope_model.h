#pragma once

#include <vector>

#include "latency_input.h"
#include "latency_model.h"

namespace asperity {

// The poses' rotations predicted from the integrated gyroscope. Parameters: latency; bias (3, rad/s, marker frame); the
// sensor's rotation (3) and scale (1) where they are to be solved. ω_marker = scale · R_marker_sensor ω_sensor − bias.
class GyroscopeModel : public LatencyModel {
 public:
  GyroscopeModel(const SensorSeries& sensor, const PoseSeries& poses, bool solve_rotation, bool solve_scale);

  double latency_s = 0.0;
  Eigen::Vector3d bias_radps = Eigen::Vector3d::Zero();
  Eigen::Quaterniond R_marker_sensor = Eigen::Quaterniond::Identity();
  double scale = 1.0;

  DriftKind drift() const override { return DriftKind::kRandomWalk; }
  const std::vector<double>& pose_t_s() const override { return poses_.t_s; }
  const std::vector<std::uint8_t>& starts() const override { return poses_.starts; }
  int parameters() const override { return 4 + (solve_rotation_ ? 3 : 0) + (solve_scale_ ? 1 : 0); }
  LatencyRows rows() const override;
  double least_drift_rate() const override { return scale * scale * noise_rate_; }
  void step(const Eigen::VectorXd& delta) override;
  Eigen::VectorXd prior_sigma() const override;

 private:
  const SensorSeries& sensor_;
  const PoseSeries& poses_;
  bool solve_rotation_, solve_scale_;
  double noise_rate_;
  std::vector<Eigen::Vector3d> step_mean_;  // of the sensor from each row to the next
};

}  // namespace asperity
