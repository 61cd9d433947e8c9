#include "asperity/geometry/pose.h"

#include <cmath>

namespace asperity {

Eigen::Quaterniond exp_rotation(const Eigen::Vector3d& phi) {
  const double square = 0.25 * phi.squaredNorm();  // of half the angle
  Eigen::Quaterniond q;
  if (square < 1e-3) {
    // By their series, whose next terms are below 3e-17: where the quotient would lose digits, and faster.
    q.w() = 1.0 - square * (1.0 / 2.0 - square * (1.0 / 24.0 - square / 720.0));
    q.vec() = (0.5 - square * (1.0 / 12.0 - square * (1.0 / 240.0 - square / 10080.0))) * phi;
    return q;
  }
  const double half = std::sqrt(square);
  q.w() = std::cos(half);
  q.vec() = 0.5 * std::sin(half) / half * phi;
  return q;
}

Eigen::Vector3d log_rotation(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  const double cosine = sign * q.w();
  const double scale = sine < 1e-8 ? 2.0 / cosine : 2.0 * std::atan2(sine, cosine) / sine;
  return sign * scale * q.vec();
}

Eigen::Quaterniond shortest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

double rotation_between_rad(const Pose& a, const Pose& b) {
  return log_rotation(a.rotation.conjugate() * b.rotation).norm();
}

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

Eigen::Vector3d lerp(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t) { return (1.0 - t) * a + t * b; }

Eigen::Quaterniond slerp(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double t) {
  const double dot = a.dot(b);
  const double sign = dot < 0.0 ? -1.0 : 1.0;
  // atan2 of difference and sum keeps its digits where acos loses them.
  const Eigen::Vector4d to = sign * b.coeffs();
  const double angle = 2.0 * std::atan2((a.coeffs() - to).norm(), (a.coeffs() + to).norm());
  Eigen::Quaterniond out;
  if (angle < 1e-6) {
    out.coeffs() = (1.0 - t) * a.coeffs() + t * to;
  } else {
    const double sine = std::sin(angle);
    out.coeffs() = std::sin((1.0 - t) * angle) / sine * a.coeffs() + std::sin(t * angle) / sine * to;
  }
  return out.normalized();
}

}  // namespace asperity
