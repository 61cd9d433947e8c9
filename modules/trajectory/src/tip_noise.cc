#include "tip_noise.h"

#include "asperity/geometry/pose.h"
#include "fused_setup.h"

namespace asperity {

namespace {

// A tracker that is stated to be exact gets a micrometre and a microradian.
constexpr double kLeastVariance = 1e-12;

}  // namespace

Eigen::Matrix3d tip_covariance_m2(const TrackerCalibration& tracker, const Eigen::Quaterniond& q_world_marker,
                                  const Eigen::Vector3d& tip_in_marker_m) {
  const Eigen::Matrix3d arm = skew(q_world_marker * tip_in_marker_m);
  Eigen::Matrix3d out = arm * tracker.sigma_rotation_rad.cwiseAbs2().asDiagonal() * arm.transpose();
  out.diagonal() += tracker.sigma_position_m.cwiseAbs2().cwiseMax(kLeastVariance);
  return out;
}

Eigen::Matrix3d tip_place_covariance_m2(const Calibration& calibration, const Eigen::Quaterniond& q_world_marker) {
  const Eigen::Matrix3d R = q_world_marker.toRotationMatrix();
  const Eigen::Vector3d sigma_m = inertial_smoother::tip_sigma_m(calibration, FusedConfig{});
  return R * sigma_m.cwiseAbs2().asDiagonal() * R.transpose();
}

Eigen::Vector3d mean_tip_variance_m2(const TrackerCalibration& tracker,
                                     std::span<const Eigen::Quaterniond> q_world_marker,
                                     const Eigen::Vector3d& tip_in_marker_m) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Quaterniond& q : q_world_marker) {
    sum += tip_covariance_m2(tracker, q, tip_in_marker_m).diagonal();
  }
  return sum / static_cast<double>(q_world_marker.size());
}

}  // namespace asperity
