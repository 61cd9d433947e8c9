#include "asperity/calibration/calibrate_imu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"
#include "imu_fit.h"
#include "latency_scan.h"

namespace asperity {

namespace {

using P = ImuParameters;

constexpr const char* kImuAdvice =
    "move the probe in the air in front of the camera for 20 s, and rotate it irregularly by some 30° about all its "
    "axes, two or three times a second";

// Means over so many samples in a row that they come at most at `fastest_Hz`.
SensorSeries thinned(const SensorSeries& sensor, double fastest_Hz) {
  if (sensor.t_s.size() < 2) return sensor;
  const double rate_Hz = static_cast<double>(sensor.t_s.size() - 1) / (sensor.t_s.back() - sensor.t_s.front());
  const auto together = static_cast<std::size_t>(std::max(1.0, std::ceil(rate_Hz / fastest_Hz)));
  if (together == 1) return sensor;
  SensorSeries out;
  std::size_t gap = 0;
  for (std::size_t first = 0; first < sensor.t_s.size();) {
    std::size_t last = std::min(first + together, sensor.t_s.size());
    while (gap < sensor.gap_after.size() && sensor.gap_after[gap] < first) ++gap;
    if (gap < sensor.gap_after.size()) last = std::min(last, sensor.gap_after[gap] + 1);
    double t_s = 0.0;
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (std::size_t i = first; i < last; ++i) {
      t_s += sensor.t_s[i] - sensor.t_s[first];
      x += sensor.x[i];
    }
    const auto n = static_cast<double>(last - first);
    out.t_s.push_back(sensor.t_s[first] + t_s / n);
    out.x.push_back(x / n);
    first = last;
  }
  return out;
}

// The longest stretch of the probe's samples without a long gap.
std::pair<double, double> longest_run_s(const SensorSeries& sensor) {
  std::pair<double, double> best{sensor.t_s.front(), sensor.t_s.front()};
  std::size_t first = 0;
  for (std::size_t g = 0; g <= sensor.gap_after.size(); ++g) {
    const std::size_t last = g < sensor.gap_after.size() ? sensor.gap_after[g] : sensor.t_s.size() - 1;
    if (sensor.t_s[last] - sensor.t_s[first] > best.second - best.first) best = {sensor.t_s[first], sensor.t_s[last]};
    first = last + 1;
  }
  return best;
}

struct Start {
  ImuParameters parameters;
  double explained = 0.0;
};

Start find_start(const Recording& recording, const SensorSeries& accelerometer, const SensorSeries& gyroscope,
                 const PoseSeries& poses, const LatencyConfig& config) {
  const Calibration& calibration = recording.calibration;
  Start out;
  P& p = out.parameters;
  p.gravity_world_mps2 = recording.info.gravity_world_mps2;
  const bool unknown = !calibration.accelerometer.rotation_known;
  LatencyScan scan;
  if (!gyroscope.t_s.empty()) {
    const bool no_scale = !calibration.gyroscope;
    scan = scan_gyroscope(gyroscope, poses, config, unknown || no_scale, no_scale);
    p.gyro_matrix = scan.R_marker_sensor.conjugate().toRotationMatrix() / scan.scale;
    if (unknown) p.R_marker_sensor = scan.R_marker_sensor;
  } else {
    const PoseInterpolator tracker(poses.t_s, poses.T_world_marker);
    scan = scan_accelerometer(accelerometer, poses, tracker, Eigen::Vector3d::Zero(), p.gravity_world_mps2, config,
                              unknown);
    p.R_marker_sensor = scan.R_marker_sensor;
  }
  p.latency_s = scan.latency_s[scan.best];
  out.explained = 1.0 - scan.cost[scan.best];
  if (scan.at_edge) {
    throw Error(
        fmt::format("calibrate imu: the best latency is at the edge of {:.3g} to {:.3g} s: widen "
                    "calibration.least_latency_s or calibration.largest_latency_s",
                    config.least_latency_s, config.largest_latency_s));
  }
  return out;
}

double turn_rms_rad(const ImuMotion& motion, const PoseSeries& poses, double latency_s) {
  double sum = 0.0, count = 0.0;
  for (const double t_s : poses.t_s) {
    if (!motion.covers(t_s - latency_s)) continue;
    sum += motion.at(t_s - latency_s).phi.squaredNorm();
    count += 1.0;
  }
  return std::sqrt(sum / std::max(1.0, count));
}

void take_fit(const ImuFit& fit, bool has_gyro, ImuCalibration& out) {
  const P& p = fit.parameters();
  const ImuFit::Dispersion dispersion = fit.dispersion();
  out.dispersion = dispersion.value;
  constexpr double kSure = 2.0;  // standard errors above chance
  const double scale = dispersion.value > 1.0 + kSure * dispersion.error ? dispersion.value : 1.0;
  const Eigen::MatrixXd covariance = scale * fit.covariance();
  const auto errors = [&](Eigen::Index at) {
    return Eigen::Vector3d(covariance.diagonal().segment<3>(at).cwiseSqrt());
  };
  out.accelerometer_in_marker_m = p.accelerometer_in_marker_m;
  out.position_covariance_m2 = covariance.block<3, 3>(P::kPosition, P::kPosition);
  out.position_error_m = errors(P::kPosition);
  out.R_marker_sensor = p.R_marker_sensor;
  out.rotation_error_rad = errors(P::kRotation);
  out.latency_s = p.latency_s;
  out.latency_error_s = std::sqrt(covariance(P::kLatency, P::kLatency));
  out.accel_bias_mps2 = p.accel_bias_mps2;
  out.accel_bias_error_mps2 = errors(P::kBias);
  out.gravity_world_mps2 = p.gravity_world_mps2;
  out.has_gyro = has_gyro;
  if (has_gyro) {
    out.gyro_matrix = p.gyro_matrix;
    out.gyro_bias_radps = p.gyro_bias_radps;
    out.gyro_bias_error_radps = errors(P::kGyroBias);
    out.gyro_noise_radps = fit.noise().sigma[ImuNoise::kGyroscope];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    out.pose_noise_m[k] = fit.noise().sigma[ImuNoise::kPosition + axis];
    out.pose_noise_rad[k] = fit.noise().sigma[ImuNoise::kRotation + axis];
  }
  out.accel_noise_mps2 = fit.noise().sigma[ImuNoise::kAccelerometer];
  out.turn_rms_rad = turn_rms_rad(fit.motion(), fit.poses(), p.latency_s);
  out.poses = fit.poses().t_s.size();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(out.position_covariance_m2);
  out.worst_direction = eigen.eigenvectors().col(2);
}

std::string direction_text(const Eigen::Vector3d& v) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", v.x(), v.y(), v.z());
}

// The direction in which the motion leaves the accelerometer's position open, in words; empty if there is none. Turning
// by a small φ moves a point ρ by φ × ρ: the information of the turns on ρ is Σ (|φ|² 1 − φφᵀ), singular for one axis.
std::string open_direction(const PoseSeries& poses) {
  constexpr double kOpen_share = 0.1;  // turned across the axis, of what it was turned about it
  const std::size_t count = poses.T_world_marker.size();
  if (count < 2) return {};
  const Eigen::Quaterniond& first = poses.T_world_marker[count / 2].rotation;
  std::vector<Eigen::Vector3d> turns;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Pose& T_world_marker : poses.T_world_marker) {
    turns.push_back(log_rotation(first.conjugate() * T_world_marker.rotation));
    mean += turns.back() / static_cast<double>(count);
  }
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& turn : turns)
    squares += (turn - mean) * (turn - mean).transpose() / static_cast<double>(count);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(squares);
  const Eigen::Vector3d rms_rad = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (!(rms_rad[1] < kOpen_share * rms_rad[2])) return {};
  const double degree = 180.0 / std::numbers::pi;
  return fmt::format(
      "the motion does not determine the accelerometer's position along {} of the marker: the probe was rotated almost "
      "only about that axis, by {:.1f}° RMS, and by {:.1f}° across it: ",
      direction_text(eigen.eigenvectors().col(2)), degree * rms_rad[2], degree * rms_rad[1]);
}

}  // namespace

ImuCalibration calibrate_imu(const Recording& recording, const ImuConfig& config) {
  if (recording.probe.size() < 2 || recording.tracker.size() < 4) {
    throw Error(fmt::format("calibrate imu: {} rows of the probe and {} poses: {}", recording.probe.size(),
                            recording.tracker.size(), kImuAdvice));
  }
  LatencyConfig search;
  search.least_latency_s = config.least_latency_s;
  search.largest_latency_s = config.largest_latency_s;
  search.largest_gap_s = config.largest_gap_s;
  SensorSeries accelerometer = accelerometer_series(recording, search), gyroscope;
  if (recording.probe.has_gyro()) gyroscope = gyroscope_series(recording, search);
  if (accelerometer.t_s.size() < 2) throw Error(fmt::format("calibrate imu: no accelerations: {}", kImuAdvice));
  const auto [first_s, last_s] = longest_run_s(accelerometer);
  PoseSeries poses = poses_within(recording, accelerometer, search);
  {
    PoseSeries inside;
    for (std::size_t i = 0; i < poses.t_s.size(); ++i) {
      if (poses.t_s[i] - search.largest_latency_s < first_s || poses.t_s[i] - search.least_latency_s > last_s) continue;
      inside.t_s.push_back(poses.t_s[i]);
      inside.T_world_marker.push_back(poses.T_world_marker[i]);
      inside.starts.push_back(inside.t_s.size() == 1 ? 1 : 0);
    }
    poses = std::move(inside);
  }
  if (poses.t_s.size() < static_cast<std::size_t>(config.least_poses)) {
    throw Error(fmt::format("calibrate imu: {} poses with samples of the probe around them, at least {} are needed: {}",
                            poses.t_s.size(), config.least_poses, kImuAdvice));
  }
  const Start start = find_start(recording, accelerometer, gyroscope, poses, search);
  const bool has_gyro = !gyroscope.t_s.empty();
  const double begin_s = poses.t_s.front() - start.parameters.latency_s,
               end_s = poses.t_s.back() - start.parameters.latency_s;
  ImuMotion motion(begin_s, end_s, config.knot_s, poses, start.parameters);
  ImuFit fit(thinned(accelerometer, config.fastest_Hz), thinned(gyroscope, config.fastest_Hz), std::move(poses),
             std::move(motion), start.parameters, config);
  bool converged = fit.run();
  std::size_t dropped = 0;
  for (int round = 0; round < 2 && converged; ++round) {
    const std::size_t more = fit.drop_outliers(config.outlier_sigmas);
    if (more == 0) break;
    dropped += more;
    converged = fit.poses().t_s.size() > static_cast<std::size_t>(config.least_poses) / 2 && fit.run();
  }
  if (!converged) {
    throw Error(fmt::format("calibrate imu: the fit did not converge: {}{}", open_direction(fit.poses()), kImuAdvice));
  }
  ImuCalibration out;
  take_fit(fit, has_gyro, out);
  out.duration_s = end_s - begin_s;
  if (dropped > 0) {
    out.problems.push_back(
        {"tracker_outlier", fmt::format("{} poses are far from the motion and were left out", dropped), dropped});
  }
  const double worst_m = std::sqrt(out.worst_direction.dot(out.position_covariance_m2 * out.worst_direction));
  if (!(worst_m <= config.largest_position_error_m)) {
    throw Error(fmt::format(
        "calibrate imu: the motion does not determine the position of the accelerometer along {} of the marker (± "
        "{:.1f} mm). The probe was hardly rotated about the axes across it ({:.1f}° RMS in all): {}",
        direction_text(out.worst_direction), 1e3 * worst_m, 57.29577951308232 * out.turn_rms_rad, kImuAdvice));
  }
  const Eigen::Vector3d& at = out.accelerometer_in_marker_m;
  out.verdict.text = fmt::format(
      "the accelerometer is at ({:.2f}, {:.2f}, {:.2f}) mm of the marker, ± {:.2g} mm at worst; the tracker {:.2f} ± "
      "{:.2f} ms behind it; from {} poses.",
      1e3 * at.x(), 1e3 * at.y(), 1e3 * at.z(), 1e3 * worst_m, 1e3 * out.latency_s, 1e3 * out.latency_error_s,
      out.poses);
  if (worst_m > config.good_position_error_m) {
    out.verdict.add(
        "imu_place_uncertain",
        fmt::format("the position of the accelerometer along {} of the marker is known to {:.1f} mm only: the probe "
                    "was rotated by {:.1f}° RMS in all, too little about the axes across it",
                    direction_text(out.worst_direction), 1e3 * worst_m, 57.29577951308232 * out.turn_rms_rad));
  }
  if (out.rotation_error_rad.maxCoeff() > config.good_rotation_error_rad) {
    out.verdict.add("imu_rotation_uncertain", fmt::format("the sensor's rotation is known to {:.1f} mrad only",
                                                          1e3 * out.rotation_error_rad.maxCoeff()));
  }
  if (out.latency_error_s > config.good_latency_error_s) {
    out.verdict.add("latency_uncertain",
                    fmt::format("the latency is known to {:.2f} ms only", 1e3 * out.latency_error_s));
  }
  return out;
}

}  // namespace asperity
