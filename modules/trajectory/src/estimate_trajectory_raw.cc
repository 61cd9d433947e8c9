#include "asperity/trajectory/estimate_trajectory_raw.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/trajectory/sample_at_probe.h"
#include "fused_setup.h"
#include "tip_noise.h"

namespace asperity {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMedianOfSquare = 0.4549;  // of a standard normal deviate

// The tips of the poses at their times by the probe's clock, each with its covariance.
TipMotion tips_of_poses(const Recording& recording) {
  const Calibration& calibration = recording.calibration;
  const TrackerStream& tracker = recording.tracker;
  if (tracker.size() < 4) throw Error(fmt::format("tracker.csv: {} poses; at least 4 are needed", tracker.size()));
  const std::int64_t latency_ns = std::llround(calibration.tracker.latency_s / kNanosecond_s);
  TipMotion out;
  for (std::size_t i = 0; i < tracker.size(); ++i) {
    const Pose& pose = tracker.T_world_marker[i];
    if (i > 0 && tracker.t_ns[i] <= tracker.t_ns[i - 1]) {
      throw Error(
          fmt::format("tracker sample {}: {} ns does not follow {} ns", i, tracker.t_ns[i], tracker.t_ns[i - 1]));
    }
    out.t_ns.push_back(tracker.t_ns[i] - latency_ns);
    out.p_world_tip_m.push_back(pose * calibration.tip_in_marker_m);
    out.q_world_marker.push_back(pose.rotation);
    out.cov_world_tip_m2.push_back(tip_covariance_m2(calibration.tracker, pose.rotation, calibration.tip_in_marker_m));
  }
  // Over ±0.1 s: between neighbours the noise is most of it.
  constexpr std::int64_t kReach_ns = 100'000'000;
  std::size_t a = 0, b = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    while (out.t_ns[a] < out.t_ns[i] - kReach_ns) ++a;
    while (b + 1 < out.size() && (b <= i || out.t_ns[b] < out.t_ns[i] + kReach_ns)) ++b;
    const std::size_t from = a == b ? b - 1 : a;
    out.v_world_tip_mps.push_back((out.p_world_tip_m[b] - out.p_world_tip_m[from]) /
                                  in_seconds(out.t_ns[b] - out.t_ns[from]));
  }
  return out;
}

double median_of(std::vector<double>& x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

// α² an axis: what the second differences show above the noise.
Vector3d acceleration_variance(const TipMotion& poses) {
  Vector3d out;
  std::vector<double> excess;
  for (int axis = 0; axis < 3; ++axis) {
    excess.clear();
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
      const double h0 = in_seconds(poses.t_ns[i] - poses.t_ns[i - 1]),
                   h1 = in_seconds(poses.t_ns[i + 1] - poses.t_ns[i]);
      if (std::max(h0, h1) > 1.5 * std::min(h0, h1)) continue;
      const double second =
          poses.p_world_tip_m[i - 1][axis] - 2.0 * poses.p_world_tip_m[i][axis] + poses.p_world_tip_m[i + 1][axis];
      const double noise = 6.0 * poses.cov_world_tip_m2[i](axis, axis);
      excess.push_back((second * second / kMedianOfSquare - noise) / std::pow(0.5 * (h0 + h1), 4));
    }
    out[axis] = excess.empty() ? 0.0 : std::max(0.0, median_of(excess));
  }
  return out;
}

}  // namespace

TrajectoryResult estimate_trajectory_raw(const Recording& recording, const RawTrajectoryConfig& config) {
  const Calibration& calibration = recording.calibration;
  const TipMotion poses = tips_of_poses(recording);
  const Outliers outliers = reject_outliers(recording.probe, calibration, config.outliers);
  TrajectoryResult result;
  result.motion = sample_at_probe(recording.probe, outliers, calibration, recording.info.gravity_world_mps2, poses);
  TipMotion& motion = result.motion;
  if (motion.size() == 0) throw Error("tracker.csv: no pose is within the probe's time span");

  const Vector3d accel2 = acceleration_variance(poses);
  // The probe's latency has no part in it: the times of poses are all that counts.
  const double latency2_s2 = std::pow(calibration.tracker.latency_sigma_s, 2);
  std::size_t k = 0;
  motion.cov_world_tip_m2.reserve(motion.size());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    while (k + 2 < poses.size() && poses.t_ns[k + 1] <= motion.t_ns[i]) ++k;
    const double h = in_seconds(poses.t_ns[k + 1] - poses.t_ns[k]);
    const double u = in_seconds(motion.t_ns[i] - poses.t_ns[k]) / h;
    const Vector3d& v = motion.v_world_tip_mps[i];
    Matrix3d cov = (1.0 - u) * (1.0 - u) * poses.cov_world_tip_m2[k] + u * u * poses.cov_world_tip_m2[k + 1];
    cov.diagonal() += std::pow(0.5 * u * (1.0 - u) * h * h, 2) * accel2;
    cov += latency2_s2 * v * v.transpose();
    cov += tip_place_covariance_m2(calibration, motion.q_world_marker[i]);
    motion.cov_world_tip_m2.push_back(cov);
  }
  motion.sigma_tip_in_marker_m = inertial_smoother::tip_sigma_m(calibration, FusedConfig{});
  result.metrics["poses"] = static_cast<double>(poses.size());
  result.metrics["interpolated_acceleration_mps2"] = std::sqrt(accel2.sum());
  return result;
}

}  // namespace asperity
