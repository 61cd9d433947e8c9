#include "asperity/trajectory/estimate_trajectory_fused.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "fused_metrics.h"
#include "fused_problem.h"
#include "fused_setup.h"
#include "inertial_smoother.h"
#include "learn_noise.h"
#include "learning_stretches.h"
#include "tip_motion.h"

namespace asperity {

namespace {

constexpr double kManyClipped = 0.01;  // of the samples

using inertial_smoother::Epoch;
using inertial_smoother::Factors;
using inertial_smoother::latency_sigma_s;
using inertial_smoother::Layout;
using inertial_smoother::Nominal;
using inertial_smoother::prior_latency_s;
using inertial_smoother::Smoothed;
using inertial_smoother::Stretch;
using SmootherProblem = inertial_smoother::Problem;
using Eigen::Vector3d;

// Weights of the next pass from the residuals of this one.
void weigh_poses(const Smoothed& smoothed, SmootherProblem& problem) {
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose < 0) continue;
    const auto i = static_cast<std::size_t>(epoch.pose);
    problem.position_weight[i] = inertial_smoother::redescending(smoothed.position_chi2[i], problem.gate_chi2);
    problem.rotation_weight[i] = inertial_smoother::redescending(smoothed.rotation_chi2[i], problem.gate_chi2);
  }
}

// What one pass of filter and smoother hands to the next.
struct Estimates {
  double latency_s = 0.0;  // of the tracker against the probe
  Factors factors;
  bool gyro_turns_too = true;
  Nominal guess;
  std::vector<Stretch> stretches;       // of the first passes; none: the whole
  std::vector<double> position_weight;  // 0 where no pass had the pose yet
  std::vector<double> rotation_weight;
};

Estimates first_estimates(const Calibration& calibration, bool has_gyro, const FusedConfig& config) {
  Estimates out;
  out.latency_s = prior_latency_s(calibration);
  out.factors = inertial_smoother::first_factors(has_gyro, config);
  return out;
}

// The problem of one pass, laid out anew with the latency in hand.
SmootherProblem prepare_problem(const Recording& recording, const InertialStream& inertial, const FusedConfig& config,
                                const Layout& layout, const Estimates& estimates) {
  SmootherProblem problem =
      inertial_smoother::make_problem(recording, inertial, config, estimates.latency_s, inertial.t_ns.front());
  problem.layout = layout;
  problem.gravity = recording.info.gravity_world_mps2;
  inertial_smoother::set_constants(recording.calibration, inertial.has_gyro, config, problem);
  problem.factors = estimates.factors;
  if (config.process_noise_scale > 0.0) problem.process_scale = config.process_noise_scale;
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
  problem.restart_covariance = problem.start_covariance;
  inertial_smoother::tie_place_to_lever(problem);
  return problem;
}

// Where the next pass linearises about the accelerometer's place: as far from the prior's middle towards the estimate
// as that is known better than the prior. The prior's pull is lost with the move, and has no weight there.
Vector3d next_lever(const Calibration& calibration, const Layout& layout, const Smoothed& smoothed) {
  const Vector3d middle = calibration.accelerometer_in_marker_m();
  const Vector3d left = smoothed.last_sigma.segment<3>(layout.lever) / inertial_smoother::lever_sigma_m(calibration);
  const Vector3d known = (Vector3d::Ones() - left.cwiseAbs2()).cwiseMax(0.0).cwiseAbs2();
  return middle + known.cwiseProduct(smoothed.last.lever - middle);
}

// Takes from a smoothed pass what the next one starts from.
void refine(const Recording& recording, const InertialStream& inertial, const FusedConfig& config,
            const SmootherProblem& problem, Smoothed& smoothed, Estimates& estimates) {
  inertial_smoother::improve_factors(smoothed.score, config, inertial.has_gyro, estimates.factors);
  if (problem.gate_innovations) inertial_smoother::widen_tracker(problem, config, smoothed, estimates.factors);
  if (problem.layout.latency >= 0) estimates.latency_s += smoothed.last.latency;
  if (!recording.calibration.accelerometer.rotation_known) estimates.guess.misalignment = smoothed.last.misalignment;
  if (problem.layout.lever >= 0) {
    const Vector3d lever = next_lever(recording.calibration, problem.layout, smoothed);
    estimates.guess.p += estimates.guess.q * (lever - estimates.guess.lever);
    estimates.guess.lever = lever;
  }
}

// The measurements of the run and what it down-weighted.
void append_metrics(const InertialStream& inertial, const SmootherProblem& problem, const Smoothed& smoothed,
                    const Calibration& calibration, const FusedConfig& config, double latency_s, double probe_latency_s,
                    TrajectoryResult& result) {
  const Layout& layout = problem.layout;
  result.problems = inertial.problems;
  inertial_smoother::append_learnt(inertial, problem, smoothed, calibration, config, result);
  auto& metrics = result.metrics;
  metrics["latency_s"] = latency_s + probe_latency_s;  // of the tracker
  metrics["probe_latency_s"] = probe_latency_s;
  if (layout.latency >= 0) metrics["latency_sigma_s"] = smoothed.last_sigma[layout.latency];
  metrics["latency_prior_sigmas"] =
      layout.latency >= 0 ? std::abs(latency_s - prior_latency_s(calibration)) / latency_sigma_s(calibration) : 0.0;
  metrics["probe_rate_Hz"] = inertial.period_s > 0.0 ? 1.0 / inertial.period_s : 0.0;
  metrics["probe_clock_jitter_s"] = inertial.clock_jitter_s;
  metrics["accel_noise_mps2"] = inertial.accel_noise_mps2;
  // Where few are clipped, what their restoration leaves is within the noise of the contact.
  if (static_cast<double>(inertial.saturated) > kManyClipped * static_cast<double>(inertial.size())) {
    metrics["accel_clipped_x_m2ps3"] = inertial.clipped_m2ps3.x();
    metrics["accel_clipped_y_m2ps3"] = inertial.clipped_m2ps3.y();
    metrics["accel_clipped_z_m2ps3"] = inertial.clipped_m2ps3.z();
  }
  metrics["probe_saturated_share"] = static_cast<double>(inertial.saturated) / static_cast<double>(inertial.size());
}

void require_finite(const Smoothed& smoothed) {
  bool finite = smoothed.last.lever.allFinite();
  for (std::size_t i = 0; i < smoothed.p.size(); ++i)
    finite = finite && smoothed.p[i].allFinite() && smoothed.q[i].coeffs().allFinite();
  if (!finite) throw Error("the trajectory's estimate is not finite: check the calibration's magnitudes");
}

// Frees what only the smoother needs: of a long recording gigabytes.
void forget_readings(InertialStream& inertial) {
  inertial.specific_force_mps2 = {};
  inertial.angular_rate_radps = {};
  inertial.accel_sigma_mps2 = {};
  inertial.gyro_sigma_radps = {};
  inertial.accel_moving_mps2 = {};
  inertial.accel_fast_m2ps4 = {};
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
  InertialStream inertial = calibrate_inertial(recording, config.inertial);
  const Layout layout = inertial_smoother::choose_layout(calibration, inertial.has_gyro, true, config);

  Estimates estimates = first_estimates(calibration, inertial.has_gyro, config);
  SmootherProblem problem;
  Smoothed smoothed;
  for (int pass = 0; pass < config.passes; ++pass) {
    problem = prepare_problem(recording, inertial, config, layout, estimates);
    if (pass == 0) {
      if (!calibration.accelerometer.rotation_known) inertial_smoother::choose_mounting(problem, inertial.has_gyro);
      estimates.guess = problem.start;
      estimates.gyro_turns_too = problem.gyro_turns_too;
      estimates.stretches = inertial_smoother::choose_stretches(problem);
    }
    // The last step of learning is from all of the recording, whatever the stretches were like.
    const bool last = pass + 1 == config.passes;
    if (pass + 2 < config.passes) problem = inertial_smoother::problem_of_stretches(problem, estimates.stretches);
    smoothed = inertial_smoother::smooth_motion(problem, calibration.tip_in_marker_m, last, observer);
    if (!last) refine(recording, inertial, config, problem, smoothed, estimates);
    weigh_poses(smoothed, problem);
    estimates.position_weight = problem.position_weight;
    estimates.rotation_weight = problem.rotation_weight;
  }

  // What the estimate adds to the prior moves each stream's latency by its share of the prior variance.
  const double latency_s = estimates.latency_s + (layout.latency >= 0 ? smoothed.last.latency : 0.0);
  const double probe_share =
      layout.latency >= 0 ? std::pow(calibration.probe_latency_sigma_s / latency_sigma_s(calibration), 2) : 0.0;
  const double probe_latency_s = calibration.probe_latency_s - probe_share * (latency_s - prior_latency_s(calibration));

  require_finite(smoothed);
  TrajectoryResult result;
  append_metrics(inertial, problem, smoothed, calibration, config, latency_s, probe_latency_s, result);
  const MotionNoise noise = inertial_smoother::learnt_noise(inertial, problem, smoothed, calibration);
  problem.knots.clear();  // they are made from the readings
  forget_readings(inertial);
  result.motion = inertial_smoother::make_tip_motion(inertial, smoothed, calibration.tip_in_marker_m);
  result.motion.sigma_tip_in_marker_m = problem.tip_sigma_m;
  result.motion.noise = noise;
  for (auto& t_ns : result.motion.t_ns) t_ns -= std::llround(probe_latency_s * 1e9);
  return result;
}

}  // namespace asperity
