#include "imu_motion.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"

namespace asperity {

namespace {

Eigen::Matrix3d right_jacobian_of(const Eigen::Vector3d& phi) {
  const double angle2 = phi.squaredNorm();
  const Eigen::Matrix3d K = skew(phi);
  constexpr double kSmall = 1e-6;
  if (angle2 < kSmall) return Eigen::Matrix3d::Identity() - 0.5 * K + K * K / 6.0;
  const double angle = std::sqrt(angle2);
  return Eigen::Matrix3d::Identity() - (1.0 - std::cos(angle)) / angle2 * K +
         (angle - std::sin(angle)) / (angle2 * angle) * K * K;
}

// The mean of the rotations near one of them.
Eigen::Quaterniond mean_rotation(const std::vector<Pose>& poses) {
  Eigen::Quaterniond mean = poses.front().rotation;
  for (int round = 0; round < 5; ++round) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Pose& pose : poses) sum += log_rotation(mean.conjugate() * pose.rotation);
    mean = (mean * exp_rotation(sum / static_cast<double>(poses.size()))).normalized();
  }
  return mean;
}

}  // namespace

ImuMotion::ImuMotion(double first_s, double last_s, double knot_s, const PoseSeries& poses, const ImuParameters& start)
    : first_s_(first_s), last_s_(last_s), knot_s_(knot_s), R0_(mean_rotation(poses.T_world_marker)) {
  const auto intervals = static_cast<Eigen::Index>(std::ceil((last_s - first_s) / knot_s));
  points_.resize(6, intervals + ArrowSystem::kSupport - 1);
  // A control point is near the curve at its own middle, two and a half knots before its last interval.
  constexpr double kFarthest_rad = 2.0;
  std::size_t row = 0;
  for (Eigen::Index j = 0; j < points_.cols(); ++j) {
    const double t_s = first_s + (static_cast<double>(j) - 2.0) * knot_s + start.latency_s;
    while (row + 2 < poses.t_s.size() && poses.t_s[row + 1] < t_s) ++row;
    const double share = std::clamp((t_s - poses.t_s[row]) / (poses.t_s[row + 1] - poses.t_s[row]), 0.0, 1.0);
    const Pose& a = poses.T_world_marker[row];
    const Pose& b = poses.T_world_marker[row + 1];
    const Pose pose{slerp(a.rotation, b.rotation, share), lerp(a.translation_m, b.translation_m, share)};
    points_.col(j).head<3>() = pose * start.accelerometer_in_marker_m;
    points_.col(j).tail<3>() = log_rotation(R0_.conjugate() * pose.rotation);
    if (!(points_.col(j).tail<3>().norm() < kFarthest_rad)) {
      throw Error(
          "calibrate imu: the probe was rotated by more than two radians from its mean direction: rotate it by some "
          "30° to all sides, with the tags in view");
    }
  }
}

ImuMotion::State ImuMotion::at(double t_s) const {
  const double knots = (t_s - first_s_) / knot_s_;
  const Eigen::Index last = points_.cols() - ArrowSystem::kSupport;
  State out;
  out.first_point = std::clamp(static_cast<Eigen::Index>(std::floor(knots)), Eigen::Index{0}, last);
  out.basis = quintic_basis(knots - static_cast<double>(out.first_point));
  Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero(), first = value, second = value;
  for (std::size_t j = 0; j < out.basis.value.size(); ++j) {
    out.basis.first[j] /= knot_s_;
    out.basis.second[j] /= knot_s_ * knot_s_;
    const auto point = points_.col(out.first_point + static_cast<Eigen::Index>(j));
    value += out.basis.value[j] * point;
    first += out.basis.first[j] * point;
    second += out.basis.second[j] * point;
  }
  out.s_m = value.head<3>();
  out.v_mps = first.head<3>();
  out.a_mps2 = second.head<3>();
  out.phi = value.tail<3>();
  out.phi_rate = first.tail<3>();
  out.R = (R0_ * exp_rotation(out.phi)).toRotationMatrix();
  out.right_jacobian = right_jacobian_of(out.phi);
  out.omega_radps = out.right_jacobian * out.phi_rate;
  constexpr double kStep_rad = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep_rad * Eigen::Vector3d::Unit(axis);
    out.omega_by_phi.col(axis) =
        (right_jacobian_of(out.phi + step) - right_jacobian_of(out.phi - step)) * out.phi_rate / (2.0 * kStep_rad);
  }
  return out;
}

ImuMotion::Bend ImuMotion::bend(Eigen::Index first_point) const {
  Bend out;
  out.t_s = first_s_ + (static_cast<double>(first_point) + 0.5) * knot_s_;
  out.second = quintic_basis(0.5).second;
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t j = 0; j < out.second.size(); ++j) {
    out.second[j] /= knot_s_ * knot_s_;
    sum += out.second[j] * points_.col(first_point + static_cast<Eigen::Index>(j));
  }
  out.a_mps2 = sum.head<3>();
  out.phi_second = sum.tail<3>();
  return out;
}

void ImuMotion::step(const Eigen::VectorXd& delta) {
  points_ += Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>(delta.data(), 6, points_.cols());
}

}  // namespace asperity
