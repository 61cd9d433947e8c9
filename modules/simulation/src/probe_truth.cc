#include "asperity/simulation/probe_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/base/random.h"
#include "asperity/base/units.h"
#include "asperity/json/json.h"
#include "noise_bandwidth.h"
#include "normal_vector.h"
#include "streams.h"

namespace asperity {
namespace {

constexpr double kAccelCountsPerG = 2048.0;  // ±16 g over 16 bits
constexpr double kGyroCountsPerDps = 16.4;   // ±2000 dps over 16 bits
constexpr double kForceNewtonPerCount = 10.0 / 32768.0;
constexpr double kCrossAxis = 0.01;  // uncorrected misalignment of a board in its case
constexpr double kScaleSpread = 0.005;
constexpr double kAccelOffset_mps2 = 0.2;  // 20 mg
constexpr double kGyroOffset_dps = 0.5;
constexpr double kForceOffset_N = 0.2;
constexpr double kForce3CountsOfRange = 0.5;  // ±10 N over the converter's range
constexpr double kForce3Range_N = 10.0;
constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kRounding_counts = 0.28867513459481287;  // 1/√12

Json list(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Matrix3d near_identity(Random& random) {
  Eigen::Matrix3d m;
  for (Eigen::Index r = 0; r < 3; ++r) {
    for (Eigen::Index c = 0; c < 3; ++c)
      m(r, c) = r == c ? 1.0 + kScaleSpread * random.normal() : kCrossAxis * random.normal();
  }
  return m;
}

double accel_noise_mps2(const SimulatedProbeConfig& probe) {
  return probe.accel_noise_mps2_per_rtHz *
         std::sqrt(noise_bandwidth_Hz(probe.accel_bandwidth_Hz, probe.accel_poles, probe.true_rate_Hz));
}

}  // namespace

Calibration make_probe_truth(const SimulatedProbeConfig& probe, const SimulatedTrackerConfig& tracker,
                             std::uint64_t seed) {
  Random random(seed, stream(Stream::kSensorTruth));
  Calibration truth;
  truth.tip_in_marker_m = Eigen::Vector3d(probe.tip_in_marker_m.data());
  truth.accelerometer.position_in_marker_m = Eigen::Vector3d(probe.sensor_in_marker_m.data());
  truth.tracker.latency_s = tracker.latency_s;
  Eigen::Matrix3d B;
  if (probe.model == ProbeModel::kWhat) {
    B << 53.4307, 15.5323, -7.0840, 11.8876, 6.9135, 53.1222, -21.1769, -55.6179, -8.5817;
    B /= kStandardGravity_mps2;
    truth.accelerometer.C = {110.6883, 120.6481, 122.0551};
    truth.force.newton_per_count = 0.025095;
    truth.force.offset_newton = -1.313768;
  } else {
    const double scale = kAccelCountsPerG / kStandardGravity_mps2;
    B = scale * near_identity(random);
    truth.accelerometer.C = scale * kAccelOffset_mps2 * normal_vector(random);
    truth.force.newton_per_count = kForceNewtonPerCount;
    truth.force.offset_newton = kForceOffset_N * random.normal();
  }
  truth.accelerometer.B = B;
  if (probe.gyroscope) {
    GyroscopeCalibration gyroscope;
    gyroscope.B = kGyroCountsPerDps / kDegree_rad * near_identity(random);
    gyroscope.C = kGyroCountsPerDps * kGyroOffset_dps * normal_vector(random);
    truth.gyroscope = gyroscope;
  }
  const double rounding = probe.quantise ? kRounding_counts : 0.0;
  if (probe.force3) {
    Random own(seed, stream(Stream::kForce3Truth));
    Force3Calibration& force3 = truth.force3.emplace();
    const double counts_per_N = kForce3CountsOfRange * (probe.adc_max - probe.adc_min) / kForce3Range_N;
    force3.B = counts_per_N * near_identity(own);
    force3.C = Eigen::Vector3d::Constant(0.5 * (probe.adc_min + probe.adc_max)) +
               counts_per_N * kForceOffset_N * normal_vector(own);
    force3.residual_newton = Eigen::Vector3d::Constant(std::hypot(probe.force3_noise_N, rounding / counts_per_N));
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    truth.accelerometer.residual_counts[axis] = std::hypot(B.row(axis).norm() * accel_noise_mps2(probe), rounding);
  }
  truth.force.residual_newton = std::hypot(probe.force_noise_N, rounding * truth.force.newton_per_count);
  return truth;
}

Calibration make_stated_calibration(const Calibration& truth, const SimulatedProbeConfig& probe,
                                    const SimulatedCalibrationConfig& config, const Eigen::Vector3d& sigma_position_m,
                                    const Eigen::Vector3d& sigma_rotation_rad, std::uint64_t seed) {
  Random random(seed, stream(Stream::kCalibration));
  const double factor = config.imperfection;
  Calibration stated = truth;
  Eigen::Matrix<double, 3, 4> errors;
  for (Eigen::Index r = 0; r < 3; ++r) {
    const double sensitivity = truth.accelerometer.B.row(r).norm();
    for (Eigen::Index c = 0; c < 3; ++c) {
      errors(r, c) = factor * config.accel_scale * sensitivity;
      stated.accelerometer.B(r, c) += errors(r, c) * random.normal();
    }
    errors(r, 3) = factor * config.accel_bias_mps2 * sensitivity;
    stated.accelerometer.C[r] += errors(r, 3) * random.normal();
  }
  stated.accelerometer.standard_errors = errors;
  if (stated.gyroscope) {
    GyroscopeCalibration& gyroscope = *stated.gyroscope;
    for (Eigen::Index r = 0; r < 3; ++r) {
      const double sensitivity = truth.gyroscope->B.row(r).norm();
      for (Eigen::Index c = 0; c < 3; ++c)
        gyroscope.B(r, c) += factor * config.gyro_scale * sensitivity * random.normal();
      gyroscope.C[r] += factor * config.gyro_bias_radps * sensitivity * random.normal();
    }
  }
  stated.force.newton_per_count *= 1.0 + factor * config.force_scale * random.normal();
  stated.force.offset_newton += factor * config.force_offset_N * random.normal();
  if (stated.force3) {
    Random own(seed, stream(Stream::kForce3Calibration));
    const double counts_per_N = truth.force3->B.col(0).norm();
    for (Eigen::Index r = 0; r < 3; ++r) {
      for (Eigen::Index c = 0; c < 3; ++c)
        stated.force3->B(r, c) += factor * config.force_scale * counts_per_N * own.normal();
      stated.force3->C[r] += factor * config.force_offset_N * counts_per_N * own.normal();
    }
  }
  // As `asperity calibrate` states them.
  const Eigen::Vector3d tip_stderr_m = Eigen::Vector3d::Constant(factor * config.tip_m);
  stated.calibrated["tip"].details = {{"stderr", {{"tip_in_marker_m", list(tip_stderr_m)}}}};
  stated.calibrated["force"].details = {
      {"stderr",
       {{"newton_per_count", factor * config.force_scale * std::abs(truth.force.newton_per_count)},
        {"offset_newton", factor * config.force_offset_N}}}};
  const Eigen::Vector3d tip_error_m = factor * config.tip_m * normal_vector(random);
  const Eigen::Vector3d sensor_error_m = factor * config.sensor_m * normal_vector(random);
  const bool at_tip = probe.sensor_in_marker_m == probe.tip_in_marker_m;
  stated.tip_in_marker_m += tip_error_m;
  stated.tip_sigma_m = Eigen::Vector3d::Constant(factor * config.tip_m);
  if (at_tip) {
    // Where the tip is, there it is: it has been calibrated with it.
    stated.accelerometer.position_in_marker_m = stated.tip_in_marker_m;
  } else {
    *stated.accelerometer.position_in_marker_m += sensor_error_m;
    stated.accelerometer.position_sigma_m = factor * config.sensor_m;
  }
  // A tracker without noise would be stated as certain, which no filter can weigh.
  constexpr double kLeastSigma = 1e-6;  // m and rad
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double wrong = std::max(0.1, 1.0 + factor * config.tracker_sigma * random.normal());
    stated.tracker.sigma_position_m[axis] = std::max(kLeastSigma, sigma_position_m[axis] * wrong);
    stated.tracker.sigma_rotation_rad[axis] = std::max(kLeastSigma, sigma_rotation_rad[axis] * wrong);
  }
  stated.tracker.latency_s = std::max(0.0, stated.tracker.latency_s + factor * config.latency_s * random.normal());
  stated.tracker.latency_sigma_s = factor * config.latency_s;
  return stated;
}

}  // namespace asperity
