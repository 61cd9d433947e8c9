#include "asperity/trajectory/estimate_trajectory_thesis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "asperity/base/units.h"
#include "asperity/trajectory/filter_orientation.h"
#include "asperity/trajectory/filter_position.h"
#include "asperity/trajectory/remove_gravity.h"
#include "asperity/trajectory/scan_speed.h"
#include "asperity/trajectory/synchronise_streams.h"
#include "tip_noise.h"

namespace asperity {
namespace {

// A speed below this is rest; Q must not vanish with it.
constexpr double kLeastScanSpeed_mps = 1e-3;
// A state that has not been measured may have the velocity of a quick hand.
constexpr double kInitialVelocity_mps = 0.1;

// A rotation that claims to be exact is believed to a microradian.
constexpr double kLeastVariance = 1e-12;

PositionFilterNoise position_noise(const ThesisTrajectoryConfig& config, double speed_mps,
                                   const Eigen::Vector3d& R_m2) {
  const double step_m = config.position_fraction * speed_mps * config.period_s;
  PositionFilterNoise noise;
  noise.process_position_m2.setConstant(step_m * step_m);
  noise.process_velocity_m2ps2.setConstant(speed_mps * speed_mps * config.period_s / config.velocity_time_s);
  if (const double a = config.white_acceleration_mps2; a > 0.0) {
    const double dt = config.period_s;
    noise.process_position_m2.setConstant(a * a * dt * dt * dt * dt / 4.0);
    noise.process_cross_m2ps.setConstant(a * a * dt * dt * dt / 2.0);
    noise.process_velocity_m2ps2.setConstant(a * a * dt * dt);
  }
  noise.measurement_m2 = R_m2;
  noise.initial_velocity_m2ps2.setConstant(kInitialVelocity_mps * kInitialVelocity_mps);
  return noise;
}

double longest_gap_s(const std::vector<std::int64_t>& t_ns) {
  std::int64_t longest_ns = 0;
  for (std::size_t i = 1; i < t_ns.size(); ++i) longest_ns = std::max(longest_ns, t_ns[i] - t_ns[i - 1]);
  return static_cast<double>(longest_ns) * kNanosecond_s;
}

void judge_trajectory(TrajectoryResult& result, std::size_t samples) {
  constexpr double kGap_s = 0.5;
  constexpr double kRejectedPart = 0.1;
  const double gap_s = result.metrics["longest_tracker_gap_s"];
  const double rejected = result.metrics["rejected_samples"];
  if (rejected > 0.0) {
    result.problems.push_back({"probe_spikes",
                               fmt::format("{:.0f} of {} probe samples step away from their neighbours and "
                                           "were interpolated over",
                                           rejected, samples),
                               static_cast<std::size_t>(rejected)});
  }
  if (gap_s > kGap_s) {
    result.trustworthy = false;
    result.verdict = fmt::format("the tracker lost the marker for {:.2f} s, which was interpolated over", gap_s);
  } else if (rejected > kRejectedPart * static_cast<double>(samples)) {
    result.trustworthy = false;
    result.verdict = fmt::format("{:.0f} of {} probe samples were rejected as spikes", rejected, samples);
  }
}

}  // namespace

TrajectoryResult estimate_trajectory_thesis(const Recording& recording, const ThesisTrajectoryConfig& config) {
  const Calibration& calibration = recording.calibration;

  // §4.1: outlier rejection, then one time base for both streams.
  const Outliers outliers = reject_outliers(recording.probe, calibration, config.outliers);
  const auto period_ns = static_cast<std::int64_t>(std::llround(config.period_s / kNanosecond_s));
  const double latency_s = calibration.tracker.latency_s - calibration.probe_latency_s;
  const SynchronisedStreams streams = synchronise_streams(recording.probe, outliers, recording.tracker, latency_s,
                                                          period_ns, config.average_over_period);

  // §4.2: Kalman filters of the tip's position and of the orientation.
  std::vector<Eigen::Vector3d> p_world_tip_m;
  std::vector<Eigen::Quaterniond> q_world_marker;
  for (const Pose& T_world_marker : streams.T_world_marker) {
    p_world_tip_m.push_back(T_world_marker * calibration.tip_in_marker_m);
    q_world_marker.push_back(T_world_marker.rotation);
  }
  const double speed_mps = std::max(kLeastScanSpeed_mps, config.scan_speed_mps > 0.0
                                                             ? config.scan_speed_mps
                                                             : average_scan_speed_mps(p_world_tip_m, config.period_s));
  const Eigen::Vector3d R_m2 = mean_tip_variance_m2(calibration.tracker, q_world_marker, calibration.tip_in_marker_m);
  FilteredPosition filtered = filter_position(p_world_tip_m, config.period_s, position_noise(config, speed_mps, R_m2));
  const double step_rad = config.rotation_rate_radps * config.period_s;
  const double rotation_rad2 = std::max(kLeastVariance, calibration.tracker.sigma_rotation_rad.squaredNorm() / 3.0);
  q_world_marker = filter_orientation(q_world_marker, step_rad * step_rad, rotation_rad2);

  TrajectoryResult result;
  TipMotion& motion = result.motion;
  motion.t_ns = streams.t_ns;
  for (std::int64_t& t_ns : motion.t_ns) t_ns -= std::llround(calibration.probe_latency_s / kNanosecond_s);
  motion.p_world_tip_m = std::move(filtered.p_m);
  motion.v_world_tip_mps = std::move(filtered.v_mps);

  // §4.3, B.1: gravity leaves the acceleration.
  motion.a_world_tip_mps2 = remove_gravity(streams.accel_counts, q_world_marker, calibration.accelerometer,
                                           recording.info.gravity_world_mps2);
  motion.q_world_marker = std::move(q_world_marker);
  motion.force_N.reserve(streams.force_counts.size());
  for (const double counts : streams.force_counts) motion.force_N.push_back(calibration.force.force_N(counts));

  result.metrics["duration_s"] = static_cast<double>(motion.t_ns.back() - motion.t_ns.front()) * kNanosecond_s;
  result.metrics["scan_speed_mps"] = speed_mps;
  result.metrics["rejected_samples"] = static_cast<double>(outliers.count);
  result.metrics["longest_tracker_gap_s"] = longest_gap_s(recording.tracker.t_ns);
  judge_trajectory(result, recording.probe.size());
  return result;
}

}  // namespace asperity
