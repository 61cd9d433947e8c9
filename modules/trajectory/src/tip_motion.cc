#include "tip_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity::inertial_smoother {

using Eigen::Vector3d;

TipMotion make_tip_motion(const InertialStream& inertial, Smoothed& smoothed, const Vector3d& tip_in_marker) {
  TipMotion out;
  const std::size_t n = smoothed.sample.size();
  const Vector3d arm_marker = tip_in_marker - smoothed.last.lever;
  out.t_ns.resize(n);
  // From the accelerometer's to the tip's motion in place.
  out.p_world_tip_m = std::move(smoothed.p);
  out.q_world_marker = std::move(smoothed.q);
  out.v_world_tip_mps = std::move(smoothed.v);
  out.a_world_tip_mps2 = std::move(smoothed.a);
  out.cov_world_tip_m2 = CovarianceLine::between(std::move(smoothed.tip_covariance), n);
  out.force_N.resize(n);
  const auto angular_acceleration = [&](std::size_t i) -> Vector3d {
    // Over ±2 ms: a shorter difference is only the gyroscope's noise.
    const auto reach = static_cast<std::size_t>(std::max(1.0, std::round(2e-3 / std::max(inertial.period_s, 1e-6))));
    const std::size_t i0 = i >= reach ? i - reach : 0;
    const std::size_t i1 = std::min(i + reach, n - 1);
    const double dt = static_cast<double>(inertial.t_ns[static_cast<std::size_t>(smoothed.sample[i1])] -
                                          inertial.t_ns[static_cast<std::size_t>(smoothed.sample[i0])]) *
                      1e-9;
    if (dt <= 0.0) return Vector3d::Zero();
    return (smoothed.omega_world[i1] - smoothed.omega_world[i0]) / dt;
  };
  std::size_t epoch = 0;
  const std::int64_t origin_ns = inertial.t_ns.front();
  for (std::size_t i = 0; i < n; ++i) {
    const auto sample = static_cast<std::size_t>(smoothed.sample[i]);
    const Vector3d arm = out.q_world_marker[i] * arm_marker;
    const Vector3d& omega = smoothed.omega_world[i];
    out.t_ns[i] = inertial.t_ns[sample];
    out.p_world_tip_m[i] += arm;
    out.v_world_tip_mps[i] += omega.cross(arm);
    out.a_world_tip_mps2[i] =
        out.a_world_tip_mps2[i] + omega.cross(omega.cross(arm)) + angular_acceleration(i).cross(arm);
    out.force_N[i] = inertial.force_N[sample];
    if (!inertial.force3_marker_N.empty())
      out.force_world_N.push_back(out.q_world_marker[i] * inertial.force3_marker_N[sample]);
    const double t = static_cast<double>(out.t_ns[i] - origin_ns) * 1e-9;
    while (epoch + 2 < smoothed.epoch_t.size() && smoothed.epoch_t[epoch + 1] <= t) ++epoch;
    if (epoch + 1 < smoothed.epoch_t.size()) {
      const double share =
          std::clamp((t - smoothed.epoch_t[epoch]) / (smoothed.epoch_t[epoch + 1] - smoothed.epoch_t[epoch]), 0.0, 1.0);
      out.cov_world_tip_m2.push_between(epoch, share);
    } else {
      out.cov_world_tip_m2.push_between(0, 0.0);
    }
  }
  return out;
}

}  // namespace asperity::inertial_smoother
