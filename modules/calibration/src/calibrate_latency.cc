#include "asperity/calibration/calibrate_latency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "acceleration_model.h"
#include "asperity/base/error.h"
#include "gyroscope_model.h"
#include "latency_scan.h"

namespace asperity {

namespace {

constexpr const char* kAdvice =
    "shake the probe for 20 s in front of the camera, and rotate it irregularly about all axes, two or three times a "
    "second";

void refuse_scan(const LatencyScan& scan, const LatencyConfig& config, const char* sensor) {
  const double cost = scan.cost[scan.best];
  if (!(cost <= config.largest_unexplained)) {
    throw Error(fmt::format(
        "calibrate latency: the {} and the tracker do not show the same motion ({:.0f} % is not explained at any "
        "latency): {}",
        sensor, 100.0 * std::min(1.0, cost), kAdvice));
  }
  if (scan.at_edge) {
    throw Error(
        fmt::format("calibrate latency: the best latency is at the edge of {:.3g} to {:.3g} s: widen "
                    "calibration.least_latency_s or calibration.largest_latency_s",
                    config.least_latency_s, config.largest_latency_s));
  }
  if (scan.runner_up == scan.best) return;
  const double ratio = scan.cost[scan.runner_up] / cost;
  constexpr double kLogLikelihood = 12.0;
  if (ratio < config.least_runner_up_ratio || 0.5 * static_cast<double>(scan.rows) * std::log(ratio) < kLogLikelihood) {
    throw Error(
        fmt::format("calibrate latency: the motion is too regular: {:.1f} ms fits nearly as well as {:.1f} ms: {}",
                    1e3 * scan.latency_s[scan.runner_up], 1e3 * scan.latency_s[scan.best], kAdvice));
  }
}

// Leaves out the poses that lie far off; the pose after one that is left out begins no new run.
std::size_t drop_outliers(const Eigen::VectorXd& worst_innovation, double sigmas, PoseSeries& poses) {
  PoseSeries kept;
  bool start = false;
  for (std::size_t i = 0; i < poses.t_s.size(); ++i) {
    start = start || poses.starts[i] != 0;
    if (worst_innovation[static_cast<Eigen::Index>(i)] > sigmas) continue;
    kept.t_s.push_back(poses.t_s[i]);
    kept.T_world_marker.push_back(poses.T_world_marker[i]);
    kept.starts.push_back(start ? 1 : 0);
    start = false;
  }
  const std::size_t dropped = poses.t_s.size() - kept.t_s.size();
  poses = std::move(kept);
  return dropped;
}

template <class Model>
LatencyEstimate estimate_robustly(Model& model, PoseSeries& poses, const LatencyConfig& config, LatencyFit& out) {
  LatencyEstimate estimate = estimate_latency(model);
  // Twice: a large outlier hides a smaller one.
  for (int round = 0; round < 2 && estimate.converged; ++round) {
    const std::size_t dropped = drop_outliers(estimate.worst_innovation, config.outlier_sigmas, poses);
    if (dropped == 0) break;
    if (round == 0) out.problems.push_back({"tracker_outlier", "", 0});
    out.problems.back().count += dropped;
    out.problems.back().message =
        fmt::format("{} poses are far from the sensor's prediction and were left out", out.problems.back().count);
    estimate = estimate_latency(model);
  }
  return estimate;
}

void take_estimate(const LatencyEstimate& estimate, const LatencyScan& scan, const PoseSeries& poses, LatencyFit& out) {
  out.latency_error_s = std::sqrt(estimate.covariance(0, 0));
  out.clock_rate = estimate.clock_rate;
  out.clock_rate_error = estimate.clock_rate_error;
  out.bias_error = estimate.covariance.diagonal().segment<3>(1).cwiseSqrt();
  out.residual = estimate.white;
  out.drift = estimate.white.cwiseProduct(estimate.ratio.cwiseSqrt());
  out.motion = scan.motion;
  out.poses = poses.t_s.size();
  out.scan_latency_s = scan.latency_s;
  out.scan_cost = scan.cost;
  if (scan.runner_up == scan.best) return;
  out.runner_up_s = scan.latency_s[scan.runner_up];
  out.runner_up_ratio = scan.cost[scan.runner_up] / scan.cost[scan.best];
}

void refuse_few_poses(const PoseSeries& poses, const LatencyConfig& config) {
  if (poses.t_s.size() >= static_cast<std::size_t>(config.least_poses)) return;
  throw Error(
      fmt::format("calibrate latency: {} poses with samples of the probe around them, at least {} are needed: {}",
                  poses.t_s.size(), config.least_poses, kAdvice));
}

LatencyFit by_gyroscope(const Recording& recording, const LatencyConfig& config) {
  const SensorSeries sensor = gyroscope_series(recording, config);
  PoseSeries poses = poses_within(recording, sensor, config);
  refuse_few_poses(poses, config);
  LatencyFit out;
  out.scale_solved = !recording.calibration.gyroscope;
  out.rotation_solved =
      config.solve_rotation || out.scale_solved || !recording.calibration.accelerometer.rotation_known;
  const LatencyScan scan = scan_gyroscope(sensor, poses, config, out.rotation_solved, out.scale_solved);
  refuse_scan(scan, config, "gyroscope");
  GyroscopeModel model(sensor, poses, out.rotation_solved, out.scale_solved);
  model.latency_s = scan.latency_s[scan.best];
  model.R_marker_sensor = scan.R_marker_sensor;
  model.scale = scan.scale;
  model.bias_radps = scan.bias;
  const LatencyEstimate estimate = estimate_robustly(model, poses, config, out);
  if (!estimate.converged) throw Error(fmt::format("calibrate latency: the fit did not converge: {}", kAdvice));
  take_estimate(estimate, scan, poses, out);
  out.latency_s = model.latency_s;
  out.bias = model.bias_radps;
  out.R_marker_sensor = model.R_marker_sensor;
  out.scale = model.scale;
  if (out.rotation_solved) out.rotation_error_rad = estimate.covariance.diagonal().segment<3>(4).cwiseSqrt();
  if (out.scale_solved) {
    out.scale_error = out.scale * std::sqrt(estimate.covariance(model.parameters() - 1, model.parameters() - 1));
  }
  return out;
}

// Where no pose came for long, the rotation between is not known.
void start_after_gaps(PoseSeries& poses) {
  constexpr double kLongest_s = 0.15;
  for (std::size_t i = 1; i < poses.t_s.size(); ++i) {
    if (poses.t_s[i] - poses.t_s[i - 1] > kLongest_s) poses.starts[i] = 1;
  }
}

// Leaves out the poses whose rotation is far off the middle of their neighbours': the accelerometer is turned by them.
std::size_t drop_flips(PoseSeries& poses) {
  constexpr double kMost = 8.0;  // of the median; a flip takes its two neighbours with it
  Eigen::VectorXd off = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(poses.t_s.size()));
  std::vector<double> sorted;
  for (std::size_t i = 1; i + 1 < poses.t_s.size(); ++i) {
    const double share = (poses.t_s[i] - poses.t_s[i - 1]) / (poses.t_s[i + 1] - poses.t_s[i - 1]);
    const Eigen::Quaterniond middle =
        slerp(poses.T_world_marker[i - 1].rotation, poses.T_world_marker[i + 1].rotation, share);
    off[static_cast<Eigen::Index>(i)] = log_rotation(middle.conjugate() * poses.T_world_marker[i].rotation).norm();
    sorted.push_back(off[static_cast<Eigen::Index>(i)]);
  }
  const auto median = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), median, sorted.end());
  return *median > 0.0 ? drop_outliers(off, kMost * *median, poses) : 0;
}

LatencyFit by_accelerometer(const Recording& recording, const LatencyConfig& config) {
  const SensorSeries sensor = accelerometer_series(recording, config);
  PoseSeries poses = poses_within(recording, sensor, config);
  start_after_gaps(poses);
  refuse_few_poses(poses, config);
  const std::size_t flips = drop_flips(poses);
  const std::vector<Pose> all = poses.T_world_marker;
  const PoseInterpolator tracker(poses.t_s, all);
  LatencyFit out;
  out.by_gyroscope = false;
  if (flips > 0) {
    out.problems.push_back({"tracker_outlier",
                            fmt::format("{} poses are rotated far from their neighbours and were left out", flips),
                            flips});
  }
  out.rotation_solved = config.solve_rotation || !recording.calibration.accelerometer.rotation_known;
  const Eigen::Vector3d lever_m = recording.calibration.accelerometer_in_marker_m();
  const Eigen::Vector3d gravity = recording.info.gravity_world_mps2;
  const LatencyScan scan = scan_accelerometer(sensor, poses, tracker, lever_m, gravity, config, out.rotation_solved);
  refuse_scan(scan, config, "accelerometer");
  // A place whose error is not stated is one measured with callipers; one that is not stated is that of the tip, and
  // may be anywhere in the probe.
  constexpr double kMeasured_m = 1e-3, kAnywhere_m = 50e-3;
  const AccelerometerCalibration& accelerometer = recording.calibration.accelerometer;
  const double stated_m = accelerometer.position_sigma_m;
  const double place_sigma_m = !accelerometer.position_in_marker_m ? std::max(stated_m, kAnywhere_m)
                               : stated_m > 0.0                    ? stated_m
                                                                   : kMeasured_m;
  AccelerationModel model(sensor, poses, tracker, lever_m, gravity, out.rotation_solved, place_sigma_m);
  model.latency_s = scan.latency_s[scan.best];
  model.R_marker_sensor = scan.R_marker_sensor;
  const LatencyEstimate estimate = estimate_robustly(model, poses, config, out);
  if (!estimate.converged) throw Error(fmt::format("calibrate latency: the fit did not converge: {}", kAdvice));
  take_estimate(estimate, scan, poses, out);
  out.latency_s = model.latency_s;
  out.bias = model.bias_mps2;
  if (out.rotation_solved) out.R_marker_sensor = model.R_marker_sensor;
  if (out.rotation_solved) out.rotation_error_rad = estimate.covariance.diagonal().segment<3>(7).cwiseSqrt();
  return out;
}

void judge_latency(const LatencyConfig& config, LatencyFit& out) {
  if (!(out.latency_error_s <= config.largest_error_s)) {
    throw Error(fmt::format(
        "calibrate latency: the motion is too weak ({:.2g} {} RMS) for more than {:.1f} ± {:.1f} ms: {}", out.motion,
        out.by_gyroscope ? "rad/s" : "m/s²", 1e3 * out.latency_s, 1e3 * out.latency_error_s, kAdvice));
  }
  out.verdict.text =
      fmt::format("the tracker is {:.2f} ± {:.2f} ms behind the probe, from {} poses by the {}.", 1e3 * out.latency_s,
                  1e3 * out.latency_error_s, out.poses, out.by_gyroscope ? "gyroscope" : "accelerometer");
  constexpr double kSure = 4.0;
  if (std::abs(out.clock_rate) > kSure * out.clock_rate_error) {
    out.verdict.text += fmt::format(" The clocks run apart by {:.0f} ± {:.0f} ppm: the latency is that of the middle.",
                                    1e6 * out.clock_rate, 1e6 * out.clock_rate_error);
  }
  if (out.latency_error_s > config.good_error_s) {
    out.verdict.add("latency_uncertain",
                    fmt::format("the latency is known to {:.2f} ms only", 1e3 * out.latency_error_s));
  }
}

void check_latency_input(const Recording& recording, const LatencyConfig& config) {
  if (!(config.largest_latency_s > config.least_latency_s)) {
    throw Error(fmt::format("calibration.largest_latency_s {} must be above least_latency_s {}",
                            config.largest_latency_s, config.least_latency_s));
  }
  if (recording.probe.size() < 2 || recording.tracker.size() < 4) {
    throw Error(fmt::format("calibrate latency: {} rows of the probe and {} poses: {}", recording.probe.size(),
                            recording.tracker.size(), kAdvice));
  }
  if (config.method == LatencyMethod::kGyroscope && !recording.probe.has_gyro()) {
    throw Error("calibrate latency: the recording has no gyroscope: calibration.method = accelerometer");
  }
}

}  // namespace

LatencyFit calibrate_latency(const Recording& recording, const LatencyConfig& config) {
  check_latency_input(recording, config);
  const bool gyroscope = config.method != LatencyMethod::kAccelerometer && recording.probe.has_gyro();
  LatencyFit out = gyroscope ? by_gyroscope(recording, config) : by_accelerometer(recording, config);
  judge_latency(config, out);
  return out;
}

}  // namespace asperity
