#include "asperity/trajectory/object_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSecond_ns = 1e9;

// The cubic through two values with their rates: weights of (value 0, rate 0, value 1, rate 1), and of its first and
// second derivative, at the share u of a step of `step_s`.
struct CubicWeights {
  std::array<double, 4> value, rate, second;
};

CubicWeights cubic_weights(double u, double step_s) {
  const double h = step_s;
  return {{(1.0 + 2.0 * u) * (1.0 - u) * (1.0 - u), h * u * (1.0 - u) * (1.0 - u), u * u * (3.0 - 2.0 * u),
           h * u * u * (u - 1.0)},
          {6.0 * u * (u - 1.0) / h, (1.0 - u) * (1.0 - 3.0 * u), 6.0 * u * (1.0 - u) / h, u * (3.0 * u - 2.0)},
          {(12.0 * u - 6.0) / (h * h), (6.0 * u - 4.0) / h, (6.0 - 12.0 * u) / (h * h), (6.0 * u - 2.0) / h}};
}

// The covariance of the cubic's value, and what the white acceleration does between two known ends:
// density·h³u³(1−u)³/3.
Matrix3d covariance_between(const ObjectKnot& a, const ObjectKnot& b, const std::array<double, 4>& weight, double u,
                            double step_s, const Vector3d& density) {
  Matrix3d out = Matrix3d::Zero();
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const auto wi = static_cast<std::size_t>(i), wj = static_cast<std::size_t>(j);
      out += weight[wi] * weight[wj] * a.covariance.block<3, 3>(3 * i, 3 * j);
      out += weight[wi + 2] * weight[wj + 2] * b.covariance.block<3, 3>(3 * i, 3 * j);
      const Matrix3d mixed = weight[wi] * weight[wj + 2] * a.with_next.block<3, 3>(3 * i, 3 * j);
      out += mixed + mixed.transpose();
    }
  }
  const double bridge_s3 = std::pow(step_s * u * (1.0 - u), 3) / 3.0;
  out.diagonal() += bridge_s3 * density;
  return out;
}

// J with exp(θ + δθ) ≈ exp(J δθ) exp(θ).
Matrix3d left_jacobian(const Vector3d& theta) {
  const double angle = theta.norm();
  const Matrix3d cross = skew(theta);
  if (angle < 1e-4) return Matrix3d::Identity() + 0.5 * cross + cross * cross / 6.0;
  return Matrix3d::Identity() + (1.0 - std::cos(angle)) / (angle * angle) * cross +
         (angle - std::sin(angle)) / (angle * angle * angle) * cross * cross;
}

}  // namespace

bool ObjectMotion::is_seen(std::int64_t time_ns) const {
  const auto after = std::upper_bound(t_ns.begin(), t_ns.end(), time_ns);
  if (after == t_ns.begin()) return false;
  if (after == t_ns.end()) return size() > 0 && time_ns == t_ns.back();
  return static_cast<double>(*after - *(after - 1)) <= longest_gap_s * kSecond_ns;
}

ObjectState ObjectMotion::at(std::int64_t time_ns) const {
  const auto after = std::upper_bound(t_ns.begin() + 1, t_ns.end() - 1, time_ns);
  const auto k = static_cast<std::size_t>(after - t_ns.begin()) - 1;
  const double step_s = static_cast<double>(t_ns[k + 1] - t_ns[k]) / kSecond_ns;
  const double u = std::clamp(static_cast<double>(time_ns - t_ns[k]) / kSecond_ns / step_s, 0.0, 1.0);
  const CubicWeights w = cubic_weights(u, step_s);
  const Pose &a = T_world_object[k], &b = T_world_object[k + 1];
  const auto mix = [&](const std::array<double, 4>& weight, const Vector3d& x0, const Vector3d& v0, const Vector3d& x1,
                       const Vector3d& v1) -> Vector3d {
    return weight[0] * x0 + weight[1] * v0 + weight[2] * x1 + weight[3] * v1;
  };
  ObjectState out;
  const auto position_by = [&](const std::array<double, 4>& weight) {
    return mix(weight, a.translation_m, position[k].rate, b.translation_m, position[k + 1].rate);
  };
  out.T_world_object.translation_m = position_by(w.value);
  out.v_mps = position_by(w.rate);
  out.a_mps2 = position_by(w.second);

  // The rotation from the earlier pose, as a vector along the world's axes.
  const Vector3d turned = log_rotation(b.rotation * a.rotation.conjugate());
  const Vector3d end_rate = left_jacobian(turned).inverse() * rotation[k + 1].rate;
  const auto vector_by = [&](const std::array<double, 4>& weight) {
    return mix(weight, Vector3d::Zero(), rotation[k].rate, turned, end_rate);
  };
  const Vector3d theta = vector_by(w.value), theta_rate = vector_by(w.rate);
  const Matrix3d J = left_jacobian(theta);
  out.T_world_object.rotation = (exp_rotation(theta) * a.rotation).normalized();
  out.omega_radps = J * theta_rate;
  // J's own rate is ½[θ̇]× to first order, which leaves θ̇ as it is.
  out.alpha_radps2 = J * vector_by(w.second);

  out.position_m2 = covariance_between(position[k], position[k + 1], w.value, u, step_s, noise.accel_m2ps3);
  out.position_m2.diagonal() += noise.slow_m.cwiseAbs2();
  out.rotation_rad2 = covariance_between(rotation[k], rotation[k + 1], w.value, u, step_s, noise.angular_rad2ps3);
  out.rotation_rad2.diagonal() += noise.slow_rad.cwiseAbs2();
  return out;
}

}  // namespace asperity
