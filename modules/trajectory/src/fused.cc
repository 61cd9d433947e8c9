#include "asperity/trajectory/fused.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "asperity/base/error.h"
#include "fused_problem.h"
#include "inertial_smoother.h"

namespace asperity {

namespace {

using inertial_smoother::Epoch;
using inertial_smoother::Layout;
using inertial_smoother::Nominal;
using inertial_smoother::Smoothed;
using inertial_smoother::Square;
using SmootherProblem = inertial_smoother::Problem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPositionFloor_m = 1e-5;  // below this a tracker's σ is not believed
constexpr double kRotationFloor_rad = 1e-4;

// Only the difference of the two streams' latencies shows in the data.
double latency_sigma_s(const Calibration& calibration) {
  return std::hypot(calibration.tracker.latency_sigma_s, calibration.probe_latency_sigma_s);
}

Layout choose_layout(const Recording& recording, const FusedConfig& config) {
  Layout layout;
  if (config.estimate_latency && latency_sigma_s(recording.calibration) > 0.0) layout.latency = layout.size++;
  if (recording.calibration.accelerometer.position_sigma_m > 0.0) {
    layout.lever = layout.size;
    layout.size += 3;
  }
  const AccelerometerCalibration& accelerometer = recording.calibration.accelerometer;
  if (!accelerometer.rotation_known || accelerometer.rotation_sigma_rad > 0.0) {
    layout.misalignment = layout.size;
    layout.size += 3;
  }
  return layout;
}

Square prior(const Recording& recording, const InertialStream& inertial, const FusedConfig& config,
             const Layout& layout) {
  namespace s = inertial_smoother;
  const Calibration& calibration = recording.calibration;
  Square P = Square::Zero(layout.size, layout.size);
  const auto set3 = [&](int at, double sigma) { P.diagonal().segment<3>(at).setConstant(sigma * sigma); };
  set3(s::kP, 0.01);    // m: the first poses are near, their noise is far below
  set3(s::kV, 0.3);     // m/s: a hand
  set3(s::kPhi, 0.05);  // rad
  set3(s::kBa, config.accel_bias_sigma_mps2);
  set3(s::kBg, inertial.has_gyro ? config.gyro_bias_sigma_radps : 2.0);  // rad/s: a hand turns
  if (layout.latency >= 0) P(layout.latency, layout.latency) = std::pow(latency_sigma_s(calibration), 2);
  if (layout.lever >= 0) set3(layout.lever, calibration.accelerometer.position_sigma_m);
  if (layout.misalignment >= 0) {
    constexpr double kGuess_rad = 0.2;  // of a rotation found from the recording itself
    set3(layout.misalignment,
         calibration.accelerometer.rotation_known ? calibration.accelerometer.rotation_sigma_rad : kGuess_rad);
  }
  return P;
}

// The factors on the process noise under which the poses are likeliest, on a stretch of the recording.
void choose_process_noise(SmootherProblem& problem, bool has_gyro) {
  constexpr double kStretch_s = 12.0;  // after which biases are known as well as anywhere
  SmootherProblem trial = inertial_smoother::first_stretch(problem, kStretch_s);
  // The sensors' own noise is a floor: a smaller factor would only fit this stretch's luck.
  const auto search = [&](double SmootherProblem::*factor, double lowest, std::initializer_list<double> steps) {
    double best = trial.*factor;
    double best_likelihood = inertial_smoother::log_likelihood(trial);
    for (const double step : steps) {
      for (const double direction : {step, 1.0 / step}) {
        while (true) {
          trial.*factor = best * direction;
          if (trial.*factor > 1e5 || trial.*factor < lowest) break;
          const double likelihood = inertial_smoother::log_likelihood(trial);
          if (!(likelihood > best_likelihood)) break;
          best = trial.*factor;
          best_likelihood = likelihood;
        }
      }
    }
    trial.*factor = best;
  };
  if (!has_gyro) search(&SmootherProblem::rate_scale, 1e-4, {10.0});
  search(&SmootherProblem::process_scale, 0.3, {8.0, 2.5});
  if (!has_gyro) search(&SmootherProblem::rate_scale, 1e-4, {3.0});
  problem.process_scale = trial.process_scale;
  problem.rate_scale = trial.rate_scale;
}

// Weights of the next pass from the residuals of this one.
void weigh_poses(const Smoothed& smoothed, SmootherProblem& problem) {
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose < 0) continue;
    const auto i = static_cast<std::size_t>(epoch.pose);
    const double dp = smoothed.position_residual[i].cwiseQuotient(problem.sigma_position).squaredNorm();
    const double dr = smoothed.rotation_residual[i].cwiseQuotient(problem.sigma_rotation).squaredNorm();
    problem.position_weight[i] = inertial_smoother::redescending(dp, problem.gate_chi2);
    problem.rotation_weight[i] = inertial_smoother::redescending(dr, problem.gate_chi2);
  }
}

// Scales each axis' σ by the robust spread of its residuals over what was assumed, within a factor of 5.
void adapt_sigma(const std::vector<Vector3d>& residuals, const SmootherProblem& problem, double floor,
                 Vector3d& sigma) {
  std::vector<double> sizes;
  for (int axis = 0; axis < 3; ++axis) {
    sizes.clear();
    for (const Epoch& epoch : problem.epochs) {
      if (epoch.pose >= 0) sizes.push_back(std::abs(residuals[static_cast<std::size_t>(epoch.pose)][axis]));
    }
    if (sizes.size() < 60) return;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double ratio = std::clamp(1.4826 * *middle / sigma[axis], 0.2, 5.0);
    // The smoothed path follows the poses a little, so residuals are smaller than the noise.
    if (ratio > 1.1 || ratio < 0.75) sigma[axis] = std::max(floor, sigma[axis] * ratio);
  }
}

void write_motion(const InertialStream& inertial, const Smoothed& smoothed, const Vector3d& tip_in_marker,
                  TipMotion& out) {
  const std::size_t n = smoothed.sample.size();
  const Vector3d arm_marker = tip_in_marker - smoothed.last.lever;
  out.t_ns.resize(n);
  out.p_world_tip_m.resize(n);
  out.q_world_marker.resize(n);
  out.v_world_tip_mps.resize(n);
  out.a_world_tip_mps2.resize(n);
  out.cov_world_tip_m2.resize(n);
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
    const Vector3d arm = smoothed.q[i] * arm_marker;
    const Vector3d& omega = smoothed.omega_world[i];
    out.t_ns[i] = inertial.t_ns[sample];
    out.q_world_marker[i] = smoothed.q[i];
    out.p_world_tip_m[i] = smoothed.p[i] + arm;
    out.v_world_tip_mps[i] = smoothed.v[i] + omega.cross(arm);
    out.a_world_tip_mps2[i] = smoothed.a[i] + omega.cross(omega.cross(arm)) + angular_acceleration(i).cross(arm);
    out.force_N[i] = inertial.force_N[sample];
    const double t = static_cast<double>(out.t_ns[i] - origin_ns) * 1e-9;
    while (epoch + 2 < smoothed.epoch_t.size() && smoothed.epoch_t[epoch + 1] <= t) ++epoch;
    if (epoch + 1 < smoothed.epoch_t.size()) {
      const double share =
          std::clamp((t - smoothed.epoch_t[epoch]) / (smoothed.epoch_t[epoch + 1] - smoothed.epoch_t[epoch]), 0.0, 1.0);
      out.cov_world_tip_m2[i] =
          (1.0 - share) * smoothed.tip_covariance[epoch] + share * smoothed.tip_covariance[epoch + 1];
    } else {
      out.cov_world_tip_m2[i] = smoothed.tip_covariance.back();
    }
  }
}

double median_norm(const std::vector<Vector3d>& residuals, const SmootherProblem& problem) {
  std::vector<double> sizes;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose >= 0) sizes.push_back(residuals[static_cast<std::size_t>(epoch.pose)].norm());
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

}  // namespace

TrajectoryResult estimate_trajectory_fused(const Recording& recording, const FusedConfig& config,
                                           const Observer& observer) {
  const TrackerCalibration& tracker = recording.calibration.tracker;
  if (recording.tracker.size() < 4) {
    throw Error("tracker.csv: " + std::to_string(recording.tracker.size()) + " poses; at least 4 are needed");
  }
  observer.update("calibrate", 0.0);
  const InertialStream inertial = calibrate_inertial(recording, config.inertial);
  const std::int64_t origin_ns = inertial.t_ns.front();
  const Layout layout = choose_layout(recording, config);

  const double prior_latency_s = tracker.latency_s - recording.calibration.probe_latency_s;
  double latency_s = prior_latency_s;  // of the tracker against the probe
  // A σ of zero says that nobody measured it: the seed's tracker stands in (Fig. 9).
  const TrackerCalibration usual;
  const Vector3d sigma_stated_m = tracker.sigma_position_m.isZero() ? usual.sigma_position_m : tracker.sigma_position_m;
  Vector3d sigma_position = sigma_stated_m.cwiseMax(kPositionFloor_m);
  Vector3d sigma_rotation =
      (tracker.sigma_rotation_rad.isZero() ? usual.sigma_rotation_rad : tracker.sigma_rotation_rad)
          .cwiseMax(kRotationFloor_rad);
  double process_scale = config.process_noise_scale;
  double rate_scale = config.process_noise_scale > 0.0 ? config.process_noise_scale : 1.0;
  std::vector<double> position_weight;
  std::vector<double> rotation_weight;
  bool gyro_turns_too = true;
  Nominal guess;
  SmootherProblem problem;
  Smoothed smoothed;
  for (int pass = 0; pass < config.passes; ++pass) {
    problem = inertial_smoother::make_problem(recording, inertial, config, latency_s, origin_ns);
    problem.layout = layout;
    problem.gravity = recording.info.gravity_world_mps2;
    problem.sigma_position = sigma_position;
    problem.sigma_rotation = sigma_rotation;
    problem.time_sigma = config.tracker_time_sigma_s;
    problem.gate_chi2 = config.gate_chi2;
    problem.accel_bias_psd = std::pow(config.accel_bias_walk_mps2_rts, 2);
    problem.gyro_bias_psd =
        std::pow(inertial.has_gyro ? config.gyro_bias_walk_radps_rts : config.angular_accel_radps2_rtHz, 2);
    problem.start_covariance = prior(recording, inertial, config, layout);
    problem.gate_innovations = pass == 0;
    if (pass > 0) {
      problem.position_weight = position_weight;
      problem.rotation_weight = rotation_weight;
    } else {
      guess = inertial_smoother::first_guess(recording, problem);
    }
    problem.start = guess;
    problem.start.latency = prior_latency_s - latency_s;
    problem.process_scale = process_scale > 0.0 ? process_scale : 1.0;
    problem.rate_scale = rate_scale;
    if (!recording.calibration.accelerometer.rotation_known) {
      if (pass == 0) {
        inertial_smoother::choose_mounting(problem, inertial.has_gyro);
        guess.misalignment = problem.start.misalignment;
        gyro_turns_too = problem.gyro_turns_too;
      }
      problem.gyro_turns_too = gyro_turns_too;
    }
    if (config.process_noise_scale == 0.0 && pass < 2) {
      observer.update("noise", 0.0);
      choose_process_noise(problem, inertial.has_gyro);
      process_scale = problem.process_scale;
      rate_scale = problem.rate_scale;
    }
    smoothed = inertial_smoother::smooth(problem, recording.calibration.tip_in_marker_m, observer);

    if (config.adapt_tracker_noise && pass + 1 < config.passes) {
      adapt_sigma(smoothed.position_residual, problem, kPositionFloor_m, sigma_position);
      adapt_sigma(smoothed.rotation_residual, problem, kRotationFloor_rad, sigma_rotation);
    }
    problem.sigma_position = sigma_position;
    problem.sigma_rotation = sigma_rotation;
    weigh_poses(smoothed, problem);
    position_weight = problem.position_weight;
    rotation_weight = problem.rotation_weight;
    if (pass + 1 < config.passes) {
      if (layout.latency >= 0) latency_s += smoothed.last.latency;
      if (!recording.calibration.accelerometer.rotation_known) guess.misalignment = smoothed.last.misalignment;
    }
  }

  if (layout.latency >= 0) latency_s += smoothed.last.latency;
  // What the estimate adds to the prior moves each stream's latency by its share of the prior variance.
  const double added_s = latency_s - prior_latency_s;
  const double probe_share =
      layout.latency < 0
          ? 0.0
          : std::pow(recording.calibration.probe_latency_sigma_s / latency_sigma_s(recording.calibration), 2);
  const double probe_latency_s = recording.calibration.probe_latency_s - probe_share * added_s;

  TrajectoryResult result;
  write_motion(inertial, smoothed, recording.calibration.tip_in_marker_m, result.motion);
  const bool finite = std::all_of(result.motion.p_world_tip_m.begin(), result.motion.p_world_tip_m.end(),
                                  [](const Vector3d& p) { return p.allFinite(); });
  if (!finite) throw Error("the trajectory's estimate is not finite: check the calibration's magnitudes");
  for (auto& t_ns : result.motion.t_ns) t_ns -= std::llround(probe_latency_s * 1e9);
  result.problems = inertial.problems;
  std::size_t poses = 0;
  std::size_t outliers = 0;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose < 0) continue;
    ++poses;
    const auto i = static_cast<std::size_t>(epoch.pose);
    outliers += position_weight[i] < 0.5 || rotation_weight[i] < 0.5;
  }
  if (outliers > 0)
    result.problems.push_back({"pose_outlier", "tracker poses far from the rest lost their weight", outliers});
  auto& figures = result.figures;
  figures["poses_used"] = static_cast<double>(poses - outliers);
  figures["poses_outlying"] = static_cast<double>(outliers);
  figures["latency_s"] = latency_s + probe_latency_s;  // of the tracker
  figures["probe_latency_s"] = probe_latency_s;
  if (layout.latency >= 0) figures["latency_sigma_s"] = smoothed.last_sigma[layout.latency];
  figures["probe_rate_Hz"] = inertial.period_s > 0.0 ? 1.0 / inertial.period_s : 0.0;
  figures["probe_clock_jitter_s"] = inertial.clock_jitter_s;
  figures["accel_noise_mps2"] = inertial.accel_noise_mps2;
  figures["process_noise_scale"] = problem.process_scale;
  if (!inertial.has_gyro) figures["angular_accel_radps2_rtHz"] = std::sqrt(problem.gyro_bias_psd * problem.rate_scale);
  figures["accel_bias_mps2"] = smoothed.last.ba.norm();
  figures["latency_prior_sigmas"] =
      layout.latency >= 0 ? std::abs(added_s) / latency_sigma_s(recording.calibration) : 0.0;
  figures["tracker_noise_ratio"] =
      problem.sigma_position.cwiseQuotient(sigma_stated_m.cwiseMax(kPositionFloor_m)).maxCoeff();
  figures["probe_saturated_share"] = static_cast<double>(inertial.saturated) / static_cast<double>(inertial.size());
  figures["position_residual_median_m"] = median_norm(smoothed.position_residual, problem);
  figures["rotation_residual_median_rad"] = median_norm(smoothed.rotation_residual, problem);
  constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    figures[std::string("tracker_sigma_") + kAxes[static_cast<std::size_t>(axis)] + "_m"] =
        problem.sigma_position[axis];
    if (layout.lever >= 0) {
      figures[std::string("accelerometer_position_") + kAxes[static_cast<std::size_t>(axis)] + "_m"] =
          smoothed.last.lever[axis];
    }
  }
  figures["poses_outlying_share"] = static_cast<double>(outliers) / static_cast<double>(poses);
  return result;
}

}  // namespace asperity
