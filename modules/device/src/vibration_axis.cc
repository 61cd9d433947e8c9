#include "asperity/device/vibration_axis.h"

#include <algorithm>

namespace asperity {

namespace {

constexpr double kSlow_s = 0.05;       // of the directions: below what is heard
constexpr double kSlowest_mps = 1e-3;  // below this speed the direction of motion counts for less
constexpr double kFastest_mps = 1e3;   // beyond it nothing moves: the mean would remember it for seconds

}  // namespace

double VibrationAxis::push(const Eigen::Vector3d& force_N, const Eigen::Vector3d& v_mps, std::int64_t t_ns) noexcept {
  const double dt_s = std::clamp(1e-9 * static_cast<double>(t_ns - last_ns_), 0.0, kSlow_s);
  last_ns_ = t_ns;
  if (!force_N.allFinite() || !(v_mps.array().abs() <= kFastest_mps).all()) return 0.0;
  force_N_ += dt_s / kSlow_s * (force_N - force_N_);
  v_mps_ += dt_s / kSlow_s * (v_mps - v_mps_);
  const double length_N = force_N_.norm();
  const Eigen::Vector3d contact = length_N > 0.0 ? Eigen::Vector3d(force_N_ / length_N) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d across_mps = v_mps_ - contact * contact.dot(v_mps_);
  return force_N.dot(contact + across_mps / (across_mps.norm() + kSlowest_mps));
}

}  // namespace asperity
