#include <algorithm>
#include <cmath>

#include "noise_sources.h"
#include "sensors.h"
#include "turn_by.h"

namespace second_bench {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// How uncertain a frame is, along the ray's axes: right, down, away. Four corners of a square tag with a fixed error in
// pixels: across the ray in proportion to the distance, along it to its square; a tag seen face on tells its tilt
// worst.
struct FrameNoise {
  Matrix3d world_from_ray;
  Vector3d sigma_m, sigma_rad;
};

FrameNoise frame_noise(const ScanPlan& plan, const Vector3d& p_m, const Quaterniond& q) {
  constexpr double kReference_m = 0.3;
  FrameNoise out;
  const Vector3d away = p_m.normalized();
  const Vector3d right = Vector3d::UnitY().cross(away).normalized();
  out.world_from_ray << right, away.cross(right), away;
  const double far = p_m.norm() / kReference_m;
  const double cosine = std::max(0.25, std::abs((q * Vector3d::UnitZ()).dot(away)));
  const double sine = std::sqrt(1.0 - cosine * cosine);
  out.sigma_m = Vector3d(plan.noise_across_m * far, plan.noise_across_m * far, plan.noise_along_m * far * far) /
                std::sqrt(cosine);
  const double tilt = plan.noise_tilt_rad * far * far * 0.5 / (0.2 + sine);
  out.sigma_rad = Vector3d(tilt, tilt, plan.noise_about_rad * far);
  return out;
}

// The marker's other pose: mirrored in depth about its own plane's direction.
Quaterniond mirrored(const Quaterniond& q, const Vector3d& away) {
  Vector3d z = q * Vector3d::UnitZ();
  if (z.dot(away) < 0.0) z = -z;
  const Vector3d axis = z.cross(away);
  const double sine = axis.norm();
  if (sine < 1e-6) return q;
  return Quaterniond(Eigen::AngleAxisd(2.0 * std::asin(std::min(1.0, sine)), axis / sine)) * q;
}

}  // namespace

PoseRows sample_tracker(const ScanPlan& plan, const HandMotion& motion) {
  Dice dice(plan.seed, 51), faults(plan.seed, 52);
  PoseRows out;
  const double slow = plan.slow_share;
  std::vector<GaussMarkov> slow_parts;
  for (int axis = 0; axis < 6; ++axis) slow_parts.emplace_back(1.0, plan.slow_time_s, dice);
  const double period_s = 1.0 / plan.frame_rate_Hz;
  const double end_s = static_cast<double>(motion.size() - 2) * kStep_s;
  double last_s = 0.0, frames = 0.0;
  int lost = 0, flipped = 0;
  for (double t_s = period_s * dice.uniform(); t_s < end_s; t_s += period_s) {
    const auto i = static_cast<std::size_t>(t_s / kStep_s);
    const Quaterniond q = motion.q_world_marker[i];
    const Vector3d p_m = motion.p_world_tip_m[i] - q * plan.tip_in_marker_m;
    const FrameNoise noise = frame_noise(plan, p_m, q);
    Vector3d error_m, error_rad;
    for (int axis = 0; axis < 3; ++axis) {
      const double slow_p = slow_parts[static_cast<std::size_t>(axis)].step(period_s, dice);
      const double slow_r = slow_parts[static_cast<std::size_t>(axis + 3)].step(period_s, dice);
      error_m[axis] = noise.sigma_m[axis] * (dice.normal() + slow * slow_p);
      error_rad[axis] = noise.sigma_rad[axis] * (dice.normal() + slow * slow_r);
    }
    const Matrix3d squares = noise.world_from_ray.cwiseAbs2();
    const Vector3d frame_m2 = squares * noise.sigma_m.cwiseAbs2(), frame_rad2 = squares * noise.sigma_rad.cwiseAbs2();
    out.rms_m += (1.0 + slow * slow) * frame_m2;
    out.rms_rad += (1.0 + slow * slow) * frame_rad2;
    frames += 1.0;
    double stamp_s = t_s + plan.latency_s + plan.frame_jitter_s * dice.normal();

    if (lost == 0 && faults.chance(plan.lost_frames)) lost = 1 + static_cast<int>(faults.exponential(2.0));
    if (flipped == 0 && faults.chance(plan.flipped_frames)) flipped = 1 + static_cast<int>(faults.exponential(1.5));
    if (faults.chance(plan.outlying_frames)) {
      const double times = faults.uniform(5.0, 20.0);
      error_m *= times;
      error_rad *= times;
    }
    PoseRow row;
    row.q = q;
    if (flipped > 0) {
      --flipped;
      row.q = mirrored(q, noise.world_from_ray.col(2));
      error_m.z() += 1.5e-3 * faults.normal();
    }
    row.p_m = p_m + noise.world_from_ray * error_m;
    row.q = (turn_by(noise.world_from_ray * error_rad) * row.q).normalized();
    row.sigma_m = frame_m2.cwiseSqrt();
    row.sigma_rad = frame_rad2.cwiseSqrt();
    if (lost > 0) {
      --lost;
      continue;
    }
    stamp_s = std::max(stamp_s, last_s + 1e-6);
    last_s = stamp_s;
    row.t_ns = kStart_ns + std::llround(1e9 * stamp_s);
    out.rows.push_back(row);
  }
  out.rms_m = (out.rms_m / frames).cwiseSqrt();
  out.rms_rad = (out.rms_rad / frames).cwiseSqrt();
  return out;
}

}  // namespace second_bench
