#include "asperity/trajectory/estimate_trajectory_fused.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "asperity/base/error.h"
#include "fused_problem.h"
#include "fused_setup.h"
#include "inertial_smoother.h"
#include "tip_motion.h"

namespace asperity {

namespace {

using inertial_smoother::Epoch;
using inertial_smoother::kPositionFloor_m;
using inertial_smoother::kRotationFloor_rad;
using inertial_smoother::latency_sigma_s;
using inertial_smoother::Layout;
using inertial_smoother::Nominal;
using inertial_smoother::prior_latency_s;
using inertial_smoother::Smoothed;
using inertial_smoother::stated_sigma_m;
using SmootherProblem = inertial_smoother::Problem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

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

double median_norm(const std::vector<Vector3d>& residuals, const SmootherProblem& problem) {
  std::vector<double> sizes;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose >= 0) sizes.push_back(residuals[static_cast<std::size_t>(epoch.pose)].norm());
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

// What one pass of filter and smoother hands to the next.
struct Estimates {
  double latency_s = 0.0;  // of the tracker against the probe
  Vector3d sigma_position_m;
  Vector3d sigma_rotation_rad;
  double process_scale = 1.0;
  double rate_scale = 1.0;
  bool gyro_turns_too = true;
  Nominal guess;
  std::vector<double> position_weight;
  std::vector<double> rotation_weight;
};

Estimates first_estimates(const Calibration& calibration, const FusedConfig& config) {
  const TrackerCalibration& tracker = calibration.tracker;
  Estimates out;
  out.latency_s = prior_latency_s(calibration);
  out.sigma_position_m = stated_sigma_m(tracker);
  out.sigma_rotation_rad = inertial_smoother::stated_sigma_rad(tracker);
  if (config.process_noise_scale > 0.0) out.process_scale = out.rate_scale = config.process_noise_scale;
  return out;
}

// The problem of one pass, laid out anew with the latency in hand.
SmootherProblem prepare(const Recording& recording, const InertialStream& inertial, const FusedConfig& config,
                        const Layout& layout, const Estimates& estimates) {
  SmootherProblem problem =
      inertial_smoother::make_problem(recording, inertial, config, estimates.latency_s, inertial.t_ns.front());
  problem.layout = layout;
  problem.gravity = recording.info.gravity_world_mps2;
  problem.sigma_position = estimates.sigma_position_m;
  problem.sigma_rotation = estimates.sigma_rotation_rad;
  inertial_smoother::set_constants(config, inertial.has_gyro, problem);
  problem.process_scale = estimates.process_scale;
  problem.rate_scale = estimates.rate_scale;
  problem.gyro_turns_too = estimates.gyro_turns_too;
  problem.start_covariance = inertial_smoother::prior(recording.calibration, inertial.has_gyro, config, layout);
  problem.gate_innovations = estimates.position_weight.empty();
  if (problem.gate_innovations) {
    problem.start = inertial_smoother::first_guess(recording, problem);
  } else {
    problem.start = estimates.guess;
    problem.position_weight = estimates.position_weight;
    problem.rotation_weight = estimates.rotation_weight;
  }
  problem.start.latency = prior_latency_s(recording.calibration) - estimates.latency_s;
  return problem;
}

// Takes from a smoothed pass what the next one starts from.
void refine(const Recording& recording, const FusedConfig& config, const Smoothed& smoothed, SmootherProblem& problem,
            Estimates& estimates) {
  if (config.adapt_tracker_noise) {
    adapt_sigma(smoothed.position_residual, problem, kPositionFloor_m, problem.sigma_position);
    adapt_sigma(smoothed.rotation_residual, problem, kRotationFloor_rad, problem.sigma_rotation);
  }
  estimates.sigma_position_m = problem.sigma_position;
  estimates.sigma_rotation_rad = problem.sigma_rotation;
  if (problem.layout.latency >= 0) estimates.latency_s += smoothed.last.latency;
  if (!recording.calibration.accelerometer.rotation_known) estimates.guess.misalignment = smoothed.last.misalignment;
}

// The measurements of the run and what it distrusted.
void report(const InertialStream& inertial, const SmootherProblem& problem, const Smoothed& smoothed,
            const Calibration& calibration, double latency_s, double probe_latency_s, TrajectoryResult& result) {
  const Layout& layout = problem.layout;
  std::size_t poses = 0;
  std::size_t outliers = 0;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose < 0) continue;
    ++poses;
    const auto i = static_cast<std::size_t>(epoch.pose);
    outliers += problem.position_weight[i] < 0.5 || problem.rotation_weight[i] < 0.5;
  }
  result.problems = inertial.problems;
  if (outliers > 0) {
    result.problems.push_back({"pose_outlier", "tracker poses far from the rest lost their weight", outliers});
  }
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
      layout.latency >= 0 ? std::abs(latency_s - prior_latency_s(calibration)) / latency_sigma_s(calibration) : 0.0;
  figures["tracker_noise_ratio"] = problem.sigma_position.cwiseQuotient(stated_sigma_m(calibration.tracker)).maxCoeff();
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
}

}  // namespace

TrajectoryResult estimate_trajectory_fused(const Recording& recording, const FusedConfig& config,
                                           const Observer& observer) {
  if (recording.tracker.size() < 4) {
    throw Error("tracker.csv: " + std::to_string(recording.tracker.size()) +
                " poses; at least 4 are needed: scan again with the markers in the camera's view");
  }
  const Calibration& calibration = recording.calibration;
  observer.update("calibrate", 0.0);
  const InertialStream inertial = calibrate_inertial(recording, config.inertial);
  const Layout layout = inertial_smoother::choose_layout(calibration, config);

  Estimates estimates = first_estimates(calibration, config);
  SmootherProblem problem;
  Smoothed smoothed;
  for (int pass = 0; pass < config.passes; ++pass) {
    problem = prepare(recording, inertial, config, layout, estimates);
    if (pass == 0) {
      if (!calibration.accelerometer.rotation_known) inertial_smoother::choose_mounting(problem, inertial.has_gyro);
      estimates.guess = problem.start;
      estimates.gyro_turns_too = problem.gyro_turns_too;
    }
    if (config.process_noise_scale == 0.0 && pass < 2) {
      observer.update("noise", 0.0);
      inertial_smoother::choose_process_noise(problem, inertial.has_gyro);
      estimates.process_scale = problem.process_scale;
      estimates.rate_scale = problem.rate_scale;
    }
    smoothed = inertial_smoother::smooth(problem, calibration.tip_in_marker_m, observer);
    if (pass + 1 < config.passes) refine(recording, config, smoothed, problem, estimates);
    weigh_poses(smoothed, problem);
    estimates.position_weight = problem.position_weight;
    estimates.rotation_weight = problem.rotation_weight;
  }

  // What the estimate adds to the prior moves each stream's latency by its share of the prior variance.
  const double latency_s = estimates.latency_s + (layout.latency >= 0 ? smoothed.last.latency : 0.0);
  const double probe_share =
      layout.latency >= 0 ? std::pow(calibration.probe_latency_sigma_s / latency_sigma_s(calibration), 2) : 0.0;
  const double probe_latency_s = calibration.probe_latency_s - probe_share * (latency_s - prior_latency_s(calibration));

  TrajectoryResult result;
  result.motion = inertial_smoother::make_tip_motion(inertial, smoothed, calibration.tip_in_marker_m);
  const bool finite = std::all_of(result.motion.p_world_tip_m.begin(), result.motion.p_world_tip_m.end(),
                                  [](const Vector3d& p) { return p.allFinite(); });
  if (!finite) throw Error("the trajectory's estimate is not finite: check the calibration's magnitudes");
  for (auto& t_ns : result.motion.t_ns) t_ns -= std::llround(probe_latency_s * 1e9);
  report(inertial, problem, smoothed, calibration, latency_s, probe_latency_s, result);
  return result;
}

}  // namespace asperity
