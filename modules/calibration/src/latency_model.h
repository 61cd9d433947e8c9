#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "drift_whitener.h"

namespace asperity {

// Tracker minus prediction for every pose, and its slopes by the parameters; rows three by three, along the
// world's axes.
struct LatencyRows {
  Eigen::VectorXd residual;
  Eigen::MatrixXd slopes;
};

// A prediction of the poses from an integrated sensor. Parameter 0 is the latency.
class LatencyModel {
 public:
  virtual ~LatencyModel() = default;
  virtual DriftKind drift() const = 0;
  virtual const std::vector<double>& pose_t_s() const = 0;
  virtual const std::vector<std::uint8_t>& starts() const = 0;  // 1 where a run of poses begins
  virtual int parameters() const = 0;
  virtual LatencyRows rows() const = 0;
  // The drift's variance rate that the sensor's own noise makes at least.
  virtual double least_drift_rate() const = 0;
  virtual void step(const Eigen::VectorXd& delta) = 0;
  // Standard deviations of what is known beforehand; infinite for what is not.
  virtual Eigen::VectorXd prior_sigma() const = 0;
  // The parameters less what is known of them beforehand.
  virtual Eigen::VectorXd from_prior() const { return Eigen::VectorXd::Zero(parameters()); }
};

// The most likely parameters by Gauss–Newton, their covariance, and the noise: white per world axis, and drift.
struct LatencyEstimate {
  Eigen::MatrixXd covariance;
  Eigen::Vector3d white = Eigen::Vector3d::Zero();
  Eigen::Vector3d ratio = Eigen::Vector3d::Zero();  // the drift's variance rate over the white variance
  Eigen::VectorXd worst_innovation;                 // of every pose, in its standard deviations
  double clock_rate = 0.0;                          // growth of the latency, of a second fit that is linear in it
  double clock_rate_error = 0.0;
  bool converged = false;
};
LatencyEstimate estimate_latency(LatencyModel& model);

}  // namespace asperity
