#include "fused_setup.h"

#include <cmath>

#include "fused_problem.h"

namespace asperity::inertial_smoother {

using Eigen::Vector3d;

double prior_latency_s(const Calibration& calibration) {
  return calibration.tracker.latency_s - calibration.probe_latency_s;
}

double latency_sigma_s(const Calibration& calibration) {
  return std::hypot(calibration.tracker.latency_sigma_s, calibration.probe_latency_sigma_s);
}

Layout choose_layout(const Calibration& calibration, const FusedConfig& config) {
  Layout layout;
  if (config.estimate_latency && latency_sigma_s(calibration) > 0.0) layout.latency = layout.size++;
  const AccelerometerCalibration& accelerometer = calibration.accelerometer;
  if (accelerometer.position_sigma_m > 0.0) {
    layout.lever = layout.size;
    layout.size += 3;
  }
  if (!accelerometer.rotation_known || accelerometer.rotation_sigma_rad > 0.0) {
    layout.misalignment = layout.size;
    layout.size += 3;
  }
  return layout;
}

Square prior(const Calibration& calibration, bool has_gyro, const FusedConfig& config, const Layout& layout) {
  Square P = Square::Zero(layout.size, layout.size);
  const auto set3 = [&](int at, double sigma) { P.diagonal().segment<3>(at).setConstant(sigma * sigma); };
  set3(kP, 0.01);    // m: the first poses are near, their noise is far below
  set3(kV, 0.3);     // m/s: a hand
  set3(kPhi, 0.05);  // rad
  set3(kBa, config.accel_bias_sigma_mps2);
  set3(kBg, has_gyro ? config.gyro_bias_sigma_radps : 2.0);  // rad/s: a hand turns
  if (layout.latency >= 0) P(layout.latency, layout.latency) = std::pow(latency_sigma_s(calibration), 2);
  if (layout.lever >= 0) set3(layout.lever, calibration.accelerometer.position_sigma_m);
  if (layout.misalignment >= 0) {
    constexpr double kGuess_rad = 0.2;  // of a rotation found from the recording itself
    set3(layout.misalignment,
         calibration.accelerometer.rotation_known ? calibration.accelerometer.rotation_sigma_rad : kGuess_rad);
  }
  return P;
}

Vector3d stated_sigma_m(const TrackerCalibration& tracker) {
  const Vector3d sigma_m =
      tracker.sigma_position_m.isZero() ? TrackerCalibration{}.sigma_position_m : tracker.sigma_position_m;
  return sigma_m.cwiseMax(kPositionFloor_m);
}

Vector3d stated_sigma_rad(const TrackerCalibration& tracker) {
  const Vector3d sigma_rad =
      tracker.sigma_rotation_rad.isZero() ? TrackerCalibration{}.sigma_rotation_rad : tracker.sigma_rotation_rad;
  return sigma_rad.cwiseMax(kRotationFloor_rad);
}

void set_constants(const FusedConfig& config, bool has_gyro, Problem& problem) {
  problem.time_sigma = config.tracker_time_sigma_s;
  problem.gate_chi2 = config.gate_chi2;
  problem.accel_bias_psd = std::pow(config.accel_bias_walk_mps2_per_rts, 2);
  problem.gyro_bias_psd =
      std::pow(has_gyro ? config.gyro_bias_walk_radps_per_rts : config.angular_accel_radps2_per_rtHz, 2);
}

void choose_process_noise(Problem& problem, bool has_gyro) {
  constexpr double kStretch_s = 12.0;  // after which biases are known as well as anywhere
  Problem trial = first_stretch(problem, kStretch_s);
  // The sensors' own noise is a floor: a smaller factor would only fit this stretch's luck.
  const auto search = [&](double Problem::*factor, double lowest, std::initializer_list<double> steps) {
    double best = trial.*factor;
    double best_likelihood = log_likelihood(trial);
    for (const double step : steps) {
      for (const double direction : {step, 1.0 / step}) {
        while (true) {
          trial.*factor = best * direction;
          if (trial.*factor > 1e5 || trial.*factor < lowest) break;
          const double likelihood = log_likelihood(trial);
          if (!(likelihood > best_likelihood)) break;
          best = trial.*factor;
          best_likelihood = likelihood;
        }
      }
    }
    trial.*factor = best;
  };
  if (!has_gyro) search(&Problem::rate_scale, 1e-4, {10.0});
  search(&Problem::process_scale, 0.3, {8.0, 2.5});
  if (!has_gyro) search(&Problem::rate_scale, 1e-4, {3.0});
  problem.process_scale = trial.process_scale;
  problem.rate_scale = trial.rate_scale;
}

}  // namespace asperity::inertial_smoother
