#include "acceleration_model.h"

#include <array>
#include <limits>

namespace asperity {

namespace {

// Acceleration, then its slopes by bias, gravity, rotation and the matrix.
using Columns = Eigen::Matrix<double, 3, 16>;
constexpr Eigen::Index kRotation = 7, kMatrix = 10, kLever = 16;  // of the parameters, and of the columns

// The scales and the three angles between the axes of a symmetric matrix.
constexpr std::array<std::array<int, 2>, 6> kSymmetric{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

// What a good calibration of the accelerometer leaves: scales, angles and rotation to half a percent.
constexpr double kMatrixSigma = 0.005;

// A sample's world acceleration, its integral and double integral.
struct Integral {
  Columns acceleration = Columns::Zero(), velocity = Columns::Zero(), position = Columns::Zero();
};

// One step to `next`, the acceleration being linear in time.
void advance_integral(Integral& s, const Columns& next, double step_s) {
  s.position += step_s * s.velocity + step_s * step_s / 6.0 * (2.0 * s.acceleration + next);
  s.velocity += 0.5 * step_s * (s.acceleration + next);
  s.acceleration = next;
}

}  // namespace

AccelerationModel::AccelerationModel(const SensorSeries& sensor, const PoseSeries& poses,
                                     const PoseInterpolator& tracker, const Eigen::Vector3d& lever_arm_m,
                                     const Eigen::Vector3d& gravity, bool solve_rotation, double lever_sigma_m)
    : gravity_world_mps2(gravity),
      sensor_(sensor),
      poses_(poses),
      tracker_(tracker),
      lever_arm_m_(lever_arm_m),
      stated_gravity_mps2_(gravity),
      solve_rotation_(solve_rotation),
      lever_sigma_m_(lever_sigma_m),
      least_drift_rate_(integral_noise_rate(sensor)) {}

Eigen::VectorXd AccelerationModel::residuals(double latency, Eigen::MatrixXd* slopes) const {
  const std::size_t poses = poses_.t_s.size();
  Eigen::VectorXd out(static_cast<Eigen::Index>(3 * poses));
  PoseInterpolator::Cursor cursor;
  const auto columns_at = [&](std::size_t row) {
    const Eigen::Matrix3d R = tracker_.at(sensor_.t_s[row] + latency, cursor).rotation.toRotationMatrix();
    const Eigen::Vector3d sensed = R_marker_sensor * sensor_.x[row];
    const Eigen::Vector3d f = sensed + matrix_error * sensed;
    Columns c;
    c.col(0) = R * (f - bias_mps2) + gravity_world_mps2;
    c.middleCols<3>(1) = -R;
    c.middleCols<3>(4).setIdentity();
    c.middleCols<3>(kRotation) = -R * skew(sensed);
    for (std::size_t k = 0; k < kSymmetric.size(); ++k) {
      const auto [a, b] = kSymmetric[k];
      Eigen::Vector3d effect = Eigen::Vector3d::Zero();
      effect[a] += sensed[b];
      if (a != b) effect[b] += sensed[a];
      c.col(kMatrix + static_cast<Eigen::Index>(k)) = R * effect;
    }
    return c;
  };
  // From the row before the first pose: earlier samples have no rotation.
  std::size_t row = row_before(sensor_.t_s, poses_.t_s[0] - latency, 0);
  Integral at;
  at.acceleration = columns_at(row);
  for (std::size_t i = 0; i < poses; ++i) {
    const double t_s = poses_.t_s[i] - latency;
    const std::size_t target = row_before(sensor_.t_s, t_s, row);
    if (poses_.starts[i] != 0) {
      row = target;
      at = Integral{};
      at.acceleration = columns_at(row);
    }
    for (; row < target; ++row) advance_integral(at, columns_at(row + 1), sensor_.t_s[row + 1] - sensor_.t_s[row]);
    const double part_s = t_s - sensor_.t_s[row];
    const double share = part_s / (sensor_.t_s[row + 1] - sensor_.t_s[row]);
    Integral there = at;
    // The next sample's columns are needed for the part of a step only.
    advance_integral(there, at.acceleration + share * (columns_at(row + 1) - at.acceleration), part_s);
    const Eigen::Vector3d seen = poses_.T_world_marker[i] * Eigen::Vector3d(lever_arm_m_ + lever_error_m);
    const auto k = static_cast<Eigen::Index>(3 * i);
    out.segment<3>(k) = seen - there.position.col(0);
    if (slopes == nullptr) continue;
    slopes->block<3, 15>(k, 1) = -there.position.rightCols<15>();
    slopes->block<3, 3>(k, kLever) = poses_.T_world_marker[i].rotation.toRotationMatrix();
  }
  return out;
}

LatencyRows AccelerationModel::rows() const {
  LatencyRows out;
  out.slopes.resize(static_cast<Eigen::Index>(3 * poses_.t_s.size()), parameters());
  out.residual = residuals(latency_s, &out.slopes);
  // The rotations move with the latency too: by differences.
  constexpr double kStep_s = 5e-4;
  out.slopes.col(0) =
      (residuals(latency_s + kStep_s, nullptr) - residuals(latency_s - kStep_s, nullptr)) / (2.0 * kStep_s);
  return out;
}

void AccelerationModel::step(const Eigen::VectorXd& delta) {
  latency_s += delta[0];
  bias_mps2 += delta.segment<3>(1);
  gravity_world_mps2 += delta.segment<3>(4);
  R_marker_sensor = (exp_rotation(delta.segment<3>(kRotation)) * R_marker_sensor).normalized();
  for (std::size_t k = 0; k < kSymmetric.size(); ++k) {
    const auto [a, b] = kSymmetric[k];
    const double change = delta[kMatrix + static_cast<Eigen::Index>(k)];
    matrix_error(a, b) += change;
    if (a != b) matrix_error(b, a) += change;
  }
  lever_error_m += delta.segment<3>(kLever);
}

Eigen::VectorXd AccelerationModel::prior_sigma() const {
  // Bias and gravity look alike while the probe keeps its orientation; bounds as wide as these decide nothing else.
  Eigen::VectorXd out = Eigen::VectorXd::Constant(parameters(), std::numeric_limits<double>::infinity());
  out.segment<3>(1).setConstant(2.0);
  out.segment<3>(4).setConstant(1.0);
  if (!solve_rotation_) out.segment<3>(kRotation).setConstant(kMatrixSigma);
  out.segment<6>(kMatrix).setConstant(kMatrixSigma);
  out.segment<3>(kLever).setConstant(lever_sigma_m_);
  return out;
}

Eigen::VectorXd AccelerationModel::from_prior() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(parameters());
  out.segment<3>(1) = bias_mps2;
  out.segment<3>(4) = gravity_world_mps2 - stated_gravity_mps2_;
  // The calibrated rotation is the identity: the samples are in the marker's frame already.
  if (!solve_rotation_) out.segment<3>(kRotation) = log_rotation(R_marker_sensor);
  for (std::size_t k = 0; k < kSymmetric.size(); ++k) {
    out[kMatrix + static_cast<Eigen::Index>(k)] = matrix_error(kSymmetric[k][0], kSymmetric[k][1]);
  }
  out.segment<3>(kLever) = lever_error_m;
  return out;
}

}  // namespace asperity
