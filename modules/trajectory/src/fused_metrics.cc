#include "fused_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "fused_setup.h"
#include "inertial_model.h"

namespace asperity::inertial_smoother {

namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

double median_norm(const std::vector<Vector3d>& residuals, const Problem& problem) {
  std::vector<double> sizes;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose >= 0) sizes.push_back(residuals[static_cast<std::size_t>(epoch.pose)].norm());
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

// The acceleration's noise in use over the sensors' own, mean power over time.
double process_noise_scale(const Problem& problem) {
  double own = 0.0, used = 0.0;
  Knot knot = problem.knots.front();
  for (std::size_t k = 0; k + 1 < problem.knots.size(); ++k) {
    const Knot next = problem.knots[k + 1];
    const double dt = next.t - knot.t;
    own += dt * knot.accel_psd[0];
    used += dt * (accel_density(knot, problem) + fast_density_factor(problem) * knot.accel_fast.head<3>().sum() / 3.0);
    knot = next;
  }
  return own > 0.0 ? used / own : 0.0;
}

void append_outliers(const Problem& problem, TrajectoryResult& result) {
  std::size_t poses = 0;
  std::size_t outliers = 0;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose < 0) continue;
    ++poses;
    const auto i = static_cast<std::size_t>(epoch.pose);
    outliers += problem.position_weight[i] < 0.5 || problem.rotation_weight[i] < 0.5;
  }
  if (outliers > 0) {
    result.problems.push_back({"pose_outlier", "tracker poses far from the others were down-weighted", outliers});
  }
  result.metrics["poses_used"] = static_cast<double>(poses - outliers);
  result.metrics["poses_outlying"] = static_cast<double>(outliers);
  result.metrics["poses_outlying_share"] = static_cast<double>(outliers) / static_cast<double>(poses);
}

}  // namespace

MotionNoise learnt_noise(const InertialStream& inertial, const Problem& problem, const Smoothed& smoothed,
                         const Calibration& calibration) {
  // One-sided: white noise of the standard deviation σ at the spacing T has 2 σ² T.
  const auto density = [](double factor, double sigma, double spacing_s) {
    return 2.0 * factor * sigma * sigma * spacing_s;
  };
  MotionNoise out;
  const double period_s = inertial.period_s;
  out.accel_m2ps3 = density(problem.process_scale * problem.factors[kAccelOwn], inertial.accel_noise_mps2, period_s);
  if (!inertial.has_gyro) out.rotation_accel_rad2ps5 = 2.0 * rate_walk_density(problem);
  double poses = 0.0, first_s = 0.0, last_s = 0.0;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose < 0) continue;
    last_s = problem.knots[epoch.knot].t;
    if (poses == 0.0) first_s = last_s;
    poses += 1.0;
  }
  const Vector3d stated_rad = stated_sigma_rad(calibration.tracker);
  const Vector3d factors(problem.factors[kRotationX], problem.factors[kRotationY], problem.factors[kRotationZ]);
  if (poses > 1.0) {
    out.rotation_rad2ps =
        density(1.0, std::sqrt(factors.dot(stated_rad.cwiseAbs2()) / 3.0), (last_s - first_s) / (poses - 1.0));
  }
  out.tip_from_sensor_m = calibration.tip_in_marker_m - smoothed.last.lever;
  return out;
}

void append_learnt(const InertialStream& inertial, const Problem& problem, const Smoothed& smoothed,
                   const Calibration& calibration, const FusedConfig& config, TrajectoryResult& result) {
  append_outliers(problem, result);
  const Layout& layout = problem.layout;
  const auto root = [&](Component component) { return std::sqrt(problem.factors[component]); };
  auto& metrics = result.metrics;
  metrics["process_noise_scale"] = process_noise_scale(problem);
  metrics["accel_own_noise_mps2"] = std::sqrt(problem.process_scale) * root(kAccelOwn) * inertial.accel_noise_mps2;
  metrics["accel_motion_share"] = std::sqrt(problem.process_scale) * root(kAccelMotion) * config.inertial.scale_error;
  metrics["accel_fast_share"] = std::sqrt(problem.process_scale) * root(kAccelFast);
  metrics["probe_time_sigma_s"] = root(kAccelJitter) * config.inertial.sample_time_sigma_s;
  metrics["accel_bias_walk_mps2_rts"] = root(kAccelWalk) * config.accel_bias_walk_mps2_per_rts;
  if (inertial.has_gyro) {
    metrics["gyro_own_noise_radps"] = root(kGyroOwn) * inertial.gyro_noise_radps;
    metrics["gyro_motion_share"] = root(kGyroMotion) * config.inertial.rate_error;
    metrics["gyro_bias_walk_radps_rts"] = root(kRateWalk) * config.gyro_bias_walk_radps_per_rts;
  } else {
    metrics["angular_accel_radps2_rtHz"] = std::sqrt(rate_walk_density(problem));
  }
  metrics["accel_bias_mps2"] = smoothed.last.ba.norm();
  const auto mean_sigma = [&](int at) { return smoothed.last_sigma.segment<9>(at).norm() / 3.0; };
  if (layout.accel_matrix >= 0) {
    metrics["accel_matrix_error"] = smoothed.last.accel_matrix.norm();
    metrics["accel_matrix_sigma"] = mean_sigma(layout.accel_matrix);
  }
  if (layout.gyro_matrix >= 0) {
    metrics["gyro_matrix_error"] = smoothed.last.gyro_matrix.norm();
    metrics["gyro_matrix_sigma"] = mean_sigma(layout.gyro_matrix);
  }
  if (layout.gravity >= 0) metrics["gravity_error_mps2"] = smoothed.last.gravity.norm();
  metrics["tracker_time_sigma_s"] = root(kPoseTime) * problem.time_sigma;
  if (layout.slow >= 0) {
    metrics["tracker_slow_sigma_m"] = root(kSlow) * problem.slow_sigma.head<3>().norm() / std::sqrt(3.0);
    metrics["tracker_slow_time_s"] = problem.slow_time_s;
    metrics["tracker_slow_sigma_rad"] = root(kSlowTurn) * problem.slow_sigma.tail<3>().norm() / std::sqrt(3.0);
  }
  constexpr std::array<Component, 3> kPosition{kPositionX, kPositionY, kPositionZ};
  constexpr std::array<Component, 3> kRotation{kRotationX, kRotationY, kRotationZ};
  const Vector3d stated_m = stated_sigma_m(calibration.tracker), stated_rad = stated_sigma_rad(calibration.tracker);
  double noise_ratio = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    noise_ratio = std::max(noise_ratio, root(kPosition[axis]));
    metrics[std::string("tracker_sigma_") + kAxes[axis] + "_m"] = root(kPosition[axis]) * stated_m[i];
    metrics[std::string("tracker_sigma_r") + kAxes[axis] + "_rad"] = root(kRotation[axis]) * stated_rad[i];
    if (layout.slow >= 0) {
      metrics[std::string("tracker_slow_sigma_") + kAxes[axis] + "_m"] = root(kSlow) * problem.slow_sigma[i];
    }
    if (layout.lever < 0) continue;
    metrics[std::string("accelerometer_position_") + kAxes[axis] + "_m"] = smoothed.last.lever[i];
    metrics[std::string("accelerometer_position_") + kAxes[axis] + "_sigma_m"] = smoothed.last_sigma[layout.lever + i];
  }
  metrics["tracker_noise_ratio"] = noise_ratio;
  const StreamAgreement& agreement = smoothed.agreement;
  metrics["tracker_scale_error"] = agreement.scale;
  metrics["tracker_scale_error_sigma"] = agreement.scale_sigma;
  metrics["tracker_axes_chi2"] = agreement.axes_chi2;
  metrics["latency_beyond_prior_s"] = agreement.latency_s;
  metrics["latency_beyond_prior_sigma_s"] = agreement.latency_sigma_s;
  metrics["latency_change_s"] = agreement.latency_change_s;
  metrics["latency_change_sigma_s"] = agreement.latency_change_sigma_s;
  metrics["accel_axes_chi2"] = agreement.accel_axes_chi2;
  metrics["gyro_axes_chi2"] = agreement.gyro_axes_chi2;
  metrics["other_axes_log_ratio"] = agreement.other_axes_log_ratio;
  metrics["position_residual_median_m"] = median_norm(smoothed.position_residual, problem);
  metrics["rotation_residual_median_rad"] = median_norm(smoothed.rotation_residual, problem);
}

}  // namespace asperity::inertial_smoother
