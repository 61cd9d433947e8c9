#include "asperity/recording/import_imu_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/base/units.h"
#include "stream_timing.h"

namespace asperity {

namespace {

constexpr double kAdcSteps = 32768.0;

// Separate streams, so that noise on the one does not change the other's.
constexpr std::uint64_t kPositionStream = 1;
constexpr std::uint64_t kRotationStream = 2;
constexpr std::uint64_t kObjectStreams = 2;  // more for the object's

Eigen::Vector3d to_counts(const Eigen::Vector3d& value, double counts_per_unit) {
  return (value * counts_per_unit).array().round().max(-kAdcSteps).min(kAdcSteps - 1.0);
}

// The rows nearest to the ticks of a regular clock, each at most once; a tick with no row within half
// a period passes without one, as a frame in which the marker was not seen.
std::vector<std::size_t> thinned_rows(const std::vector<std::int64_t>& t_ns, double rate_Hz) {
  std::vector<std::size_t> rows;
  if (rate_Hz <= 0.0) {
    for (std::size_t i = 0; i < t_ns.size(); ++i) rows.push_back(i);
    return rows;
  }
  const double period_ns = 1.0 / (rate_Hz * kNanosecond_s);
  double best_tick = -1.0;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < t_ns.size(); ++i) {
    const double position = static_cast<double>(t_ns[i] - t_ns.front()) / period_ns;
    const double tick = std::round(position);
    const double distance = std::abs(position - tick);
    if (tick != best_tick) {
      rows.push_back(i);
    } else if (distance < best_distance) {
      rows.back() = i;
    } else {
      continue;
    }
    best_tick = tick;
    best_distance = distance;
  }
  return rows;
}

Eigen::Vector3d noise(Random& random, const std::array<double, 3>& sigma) {
  Eigen::Vector3d out;
  for (int i = 0; i < 3; ++i) out[i] = sigma[static_cast<std::size_t>(i)] * random.normal();
  return out;
}

TrackerStream thinned_tracker(const std::vector<std::int64_t>& t_ns, const std::vector<Pose>& T_world_body,
                              const ImportConfig& config, std::uint64_t streams) {
  Random position_random(static_cast<std::uint64_t>(config.seed), kPositionStream + streams);
  Random rotation_random(static_cast<std::uint64_t>(config.seed), kRotationStream + streams);
  TrackerStream out;
  for (const std::size_t row : thinned_rows(t_ns, config.pose_rate_Hz)) {
    Pose pose = T_world_body[row];
    pose.translation_m += noise(position_random, config.pose_noise_m);
    const Eigen::Vector3d turn_rad = noise(rotation_random, config.rotation_noise_rad);
    if (!turn_rad.isZero(0.0)) pose.rotation = (exp_rotation(turn_rad) * pose.rotation).normalized();
    out.t_ns.push_back(t_ns[row]);
    out.T_world_marker.push_back(pose);
  }
  return out;
}

ProbeStream counted_probe(const ImportInput& input) {
  ProbeStream out;
  out.t_ns = input.imu_t_ns;
  out.force_counts.assign(out.t_ns.size(), 0.0);
  const double per_mps2 = kAdcSteps / input.accelerometer_range_mps2;
  const double per_radps = kAdcSteps / input.gyroscope_range_radps;
  for (const auto& f : input.specific_force_mps2) out.accel_counts.push_back(to_counts(f, per_mps2));
  for (const auto& omega : input.rate_radps) out.gyro_counts.push_back(to_counts(omega, per_radps));
  return out;
}

Truth full_truth(const ImportInput& input) {
  Truth out;
  out.t_ns = input.pose_t_ns;
  const std::vector<double> unknown(out.t_ns.size(), std::numeric_limits<double>::quiet_NaN());
  out.s_m = out.height_m = out.force_N = unknown;
  for (const auto& pose : input.T_world_body) {
    out.p_world_tip_m.push_back(pose.translation_m);
    out.q_world_marker.push_back(pose.rotation);
  }
  return out;
}

double first_above_zero(double stated, double estimated, double assumed) {
  return stated > 0.0 ? stated : estimated > 0.0 ? estimated : assumed;
}

Calibration known_calibration(const ImportInput& input, const ImportConfig& config) {
  Calibration out;
  out.accelerometer.B = kAdcSteps / input.accelerometer_range_mps2 * Eigen::Matrix3d::Identity();
  out.accelerometer.position_in_marker_m = Eigen::Vector3d::Zero();
  out.accelerometer.position_sigma_m = config.accelerometer_position_sigma_m;
  out.gyroscope = GyroscopeCalibration{kAdcSteps / input.gyroscope_range_radps * Eigen::Matrix3d::Identity(),
                                       Eigen::Vector3d::Zero()};
  out.force.axis_in_marker = Eigen::Vector3d::UnitZ();
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    out.tracker.sigma_position_m[i] =
        std::hypot(config.pose_noise_m[axis],
                   first_above_zero(config.tracker_sigma_m, input.sigma_position_m[i], kAssumedPoseNoise_m));
    out.tracker.sigma_rotation_rad[i] =
        std::hypot(config.rotation_noise_rad[axis],
                   first_above_zero(config.tracker_sigma_rad, input.sigma_rotation_rad[i], kAssumedPoseNoise_rad));
  }
  out.probe_latency_sigma_s = config.latency_sigma_s;  // the poses are the truth: their clock counts
  return out;
}

void check_import(const ImportInput& input) {
  if (input.imu_t_ns.empty()) throw Error("import: the inertial samples are missing");
  if (input.pose_t_ns.empty()) throw Error("import: the poses are missing");
  const bool equal =
      input.specific_force_mps2.size() == input.imu_t_ns.size() && input.rate_radps.size() == input.imu_t_ns.size() &&
      input.T_world_body.size() == input.pose_t_ns.size() && input.T_world_object.size() == input.object_t_ns.size();
  if (!equal) throw Error("import: the columns of a stream differ in length");
}

double rate_of(const std::vector<std::int64_t>& t_ns) {
  const double rate_Hz = stream_timing(t_ns).median_rate_Hz;
  return std::isfinite(rate_Hz) ? rate_Hz : 0.0;
}

}  // namespace

Recording import_imu_pose(const ImportInput& input, const ImportConfig& config) {
  check_import(input);
  Recording out;
  out.probe = counted_probe(input);
  out.tracker = thinned_tracker(input.pose_t_ns, input.T_world_body, config, 0);
  if (!input.object_t_ns.empty()) {
    out.info.bodies.push_back({std::string(kObjectBody), {}});
    out.body_poses.push_back(thinned_tracker(input.object_t_ns, input.T_world_object, config, kObjectStreams));
  }
  out.truth = full_truth(input);
  out.calibration = known_calibration(input, config);
  out.problems = input.problems;

  out.info.object = config.object;
  out.info.world = "z_up";
  out.info.gravity_world_mps2 = {0.0, 0.0, -config.gravity_mps2};
  out.info.probe_model = "imported";
  out.info.probe_rate_Hz = rate_of(input.imu_t_ns);
  out.info.adc_min = -kAdcSteps;
  out.info.adc_max = kAdcSteps - 1.0;
  out.info.tracker_rate_Hz = config.pose_rate_Hz > 0.0 ? config.pose_rate_Hz : rate_of(input.pose_t_ns);
  for (const auto& problem : input.problems)
    out.info.problems[problem.kind] += static_cast<std::int64_t>(problem.count);
  out.info.imported = {config.pose_rate_Hz, config.pose_noise_m, config.rotation_noise_rad, config.seed};
  out.info.has_force_sensor = false;
  return out;
}

}  // namespace asperity
