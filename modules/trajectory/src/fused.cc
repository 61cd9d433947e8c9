#include "asperity/trajectory/fused.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "asperity/base/error.h"
#include "fused_problem.h"
#include "inertial_smoother.h"
#include "tip_motion.h"

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

double prior_latency_s(const Calibration& calibration) {
  return calibration.tracker.latency_s - calibration.probe_latency_s;
}

// A σ of zero says that nobody measured it: the seed's tracker stands in (Fig. 9).
Vector3d stated_sigma_m(const TrackerCalibration& tracker) {
  const Vector3d sigma_m =
      tracker.sigma_position_m.isZero() ? TrackerCalibration{}.sigma_position_m : tracker.sigma_position_m;
  return sigma_m.cwiseMax(kPositionFloor_m);
}

Estimates first_estimates(const Calibration& calibration, const FusedConfig& config) {
  const TrackerCalibration& tracker = calibration.tracker;
  Estimates out;
  out.latency_s = prior_latency_s(calibration);
  out.sigma_position_m = stated_sigma_m(tracker);
  out.sigma_rotation_rad =
      (tracker.sigma_rotation_rad.isZero() ? TrackerCalibration{}.sigma_rotation_rad : tracker.sigma_rotation_rad)
          .cwiseMax(kRotationFloor_rad);
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
  problem.time_sigma = config.tracker_time_sigma_s;
  problem.gate_chi2 = config.gate_chi2;
  problem.accel_bias_psd = std::pow(config.accel_bias_walk_mps2_rts, 2);
  problem.gyro_bias_psd =
      std::pow(inertial.has_gyro ? config.gyro_bias_walk_radps_rts : config.angular_accel_radps2_rtHz, 2);
  problem.process_scale = estimates.process_scale;
  problem.rate_scale = estimates.rate_scale;
  problem.gyro_turns_too = estimates.gyro_turns_too;
  problem.start_covariance = prior(recording, inertial, config, layout);
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
    throw Error("tracker.csv: " + std::to_string(recording.tracker.size()) + " poses; at least 4 are needed");
  }
  const Calibration& calibration = recording.calibration;
  observer.update("calibrate", 0.0);
  const InertialStream inertial = calibrate_inertial(recording, config.inertial);
  const Layout layout = choose_layout(recording, config);

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
      choose_process_noise(problem, inertial.has_gyro);
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
