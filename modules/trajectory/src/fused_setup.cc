#include "fused_setup.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>

namespace asperity::inertial_smoother {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Standard deviations of E, where the true specific force is (1 + E) times the calibrated one: of B's elements, as
// stated, through B⁻¹.
Matrix3d accel_matrix_sigma(const AccelerometerCalibration& accelerometer, double unknown) {
  if (accelerometer.standard_errors.cols() < 3) return Matrix3d::Constant(unknown);
  const Matrix3d inverse = accelerometer.B.leftCols<3>().inverse();
  const Matrix3d stated = accelerometer.standard_errors.leftCols<3>();
  return (inverse.cwiseAbs2() * stated.cwiseAbs2()).cwiseSqrt();
}

double sigma_by_law(const NoiseLaw& law, double distance_m, double cosine) {
  return law.scale * std::pow(distance_m, law.power) * std::pow(cosine, -law.tilt_power);
}

PoseNoise noise_by_law(const TrackerNoiseModel& model, const std::vector<MarkerPlacement>& markers, const Pose& pose) {
  constexpr double kLeastCosine = 0.2;  // a tag that is seen more obliquely is not found
  const double distance_m = std::max(pose.translation_m.norm(), 1e-3);
  const Vector3d ray = pose.translation_m / distance_m;
  const auto facing = [&](const Eigen::Quaterniond& tag) {
    return std::abs((pose.rotation * tag * Vector3d::UnitZ()).dot(ray));
  };
  double cosine = markers.empty() ? facing(Eigen::Quaterniond::Identity()) : 0.0;
  for (const MarkerPlacement& marker : markers) cosine = std::max(cosine, facing(marker.T_marker_tag.rotation));
  cosine = std::clamp(cosine, kLeastCosine, 1.0);
  const auto covariance = [&](const NoiseLaw& along, const NoiseLaw& across, double floor) -> Matrix3d {
    const double along2 = std::pow(std::max(floor, sigma_by_law(along, distance_m, cosine)), 2);
    const double across2 = std::pow(std::max(floor, sigma_by_law(across, distance_m, cosine)), 2);
    return across2 * Matrix3d::Identity() + (along2 - across2) * ray * ray.transpose();
  };
  return {covariance(model.along_m, model.across_m, kPositionFloor_m),
          covariance(model.about_rad, model.tilt_rad, kRotationFloor_rad)};
}

}  // namespace

double prior_latency_s(const Calibration& calibration) {
  return calibration.tracker.latency_s - calibration.probe_latency_s;
}

double latency_sigma_s(const Calibration& calibration) {
  return std::hypot(calibration.tracker.latency_sigma_s, calibration.probe_latency_sigma_s);
}

double lever_sigma_m(const Calibration& calibration) {
  const AccelerometerCalibration& accelerometer = calibration.accelerometer;
  if (accelerometer.position_in_marker_m) return accelerometer.position_sigma_m;
  return std::max(accelerometer.position_sigma_m, kPlaceUnknown_m);
}

Layout choose_layout(const Calibration& calibration, bool has_gyro, bool whole, const FusedConfig& config) {
  Layout layout;
  const auto take = [&](int& at, int size) {
    at = layout.size;
    layout.size += size;
  };
  if (config.estimate_latency && latency_sigma_s(calibration) > 0.0) take(layout.latency, 1);
  const AccelerometerCalibration& accelerometer = calibration.accelerometer;
  if (lever_sigma_m(calibration) > 0.0) take(layout.lever, 3);
  if (!accelerometer.rotation_known || accelerometer.rotation_sigma_rad > 0.0) take(layout.misalignment, 3);
  if (!whole) return layout;
  if (config.accel_matrix_sigma > 0.0) take(layout.accel_matrix, 9);
  if (has_gyro && config.gyro_matrix_sigma > 0.0) take(layout.gyro_matrix, 9);
  if (config.gravity_sigma_mps2 > 0.0) take(layout.gravity, 3);
  if (slow_sigma(calibration, config).maxCoeff() > 0.0) take(layout.slow, 6);
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
  if (layout.lever >= 0) set3(layout.lever, lever_sigma_m(calibration));
  if (layout.misalignment >= 0) {
    constexpr double kGuess_rad = 0.2;  // of a rotation found from the recording itself
    set3(layout.misalignment,
         calibration.accelerometer.rotation_known ? calibration.accelerometer.rotation_sigma_rad : kGuess_rad);
  }
  if (layout.accel_matrix >= 0) {
    P.diagonal().segment<9>(layout.accel_matrix) =
        accel_matrix_sigma(calibration.accelerometer, config.accel_matrix_sigma).cwiseAbs2().reshaped();
  }
  if (layout.gyro_matrix >= 0) {
    P.diagonal().segment<9>(layout.gyro_matrix).setConstant(std::pow(config.gyro_matrix_sigma, 2));
  }
  if (layout.gravity >= 0) set3(layout.gravity, config.gravity_sigma_mps2);
  if (layout.slow >= 0) {
    P.diagonal().segment<6>(layout.slow) = slow_sigma(calibration, config).cwiseAbs2();
  }
  return P;
}

void tie_place_to_lever(Problem& problem) {
  const int at = problem.layout.lever;
  if (at < 0) return;
  Square& P = problem.start_covariance;
  const Matrix3d R = problem.start.q.toRotationMatrix();
  const Matrix3d lever = P.block<3, 3>(at, at);
  P.block<3, 3>(kP, kP) += R * lever * R.transpose();
  P.block<3, 3>(kP, at) = R * lever;
  P.block<3, 3>(at, kP) = (R * lever).transpose();
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

std::vector<PoseNoise> stated_pose_noise(const TrackerStream& stream, const Calibration& calibration,
                                         const RecordingInfo& info, std::string_view body) {
  const PoseNoise all{stated_sigma_m(calibration.tracker).cwiseAbs2().asDiagonal(),
                      stated_sigma_rad(calibration.tracker).cwiseAbs2().asDiagonal()};
  std::vector<PoseNoise> out(stream.size(), all);
  const bool by_law = calibration.tracker.noise_model && info.world == "camera";
  const std::vector<MarkerPlacement> markers = markers_of_body(calibration.markers, body);
  const auto known = [](const std::vector<Vector3d>& sigma, std::size_t i) {
    return i < sigma.size() && sigma[i].allFinite() && (sigma[i].array() > 0.0).all();
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (by_law) out[i] = noise_by_law(*calibration.tracker.noise_model, markers, stream.T_world_marker[i]);
    // What all poses share is no noise: a scan is as exact as they agree.
    const auto& position_m = known(stream.noise_position_m, i) ? stream.noise_position_m : stream.sigma_position_m;
    const auto& rotation_rad =
        known(stream.noise_rotation_rad, i) ? stream.noise_rotation_rad : stream.sigma_rotation_rad;
    if (known(position_m, i)) {
      out[i].position_m2 = position_m[i].cwiseMax(kPositionFloor_m).cwiseAbs2().asDiagonal();
    }
    if (known(rotation_rad, i)) {
      out[i].rotation_rad2 = rotation_rad[i].cwiseMax(kRotationFloor_rad).cwiseAbs2().asDiagonal();
    }
  }
  return out;
}

Eigen::Matrix<double, 6, 1> slow_sigma(const Calibration& calibration, const FusedConfig& config) {
  const TrackerCalibration& tracker = calibration.tracker;
  Eigen::Matrix<double, 6, 1> out;
  out << stated_sigma_m(tracker), stated_sigma_rad(tracker);
  if (!tracker.slow_sigma_m || config.slow_share == 0.0) return config.slow_share * out;
  // Of the rotation's nothing is stated: the same share of its white noise.
  out.tail<3>() *= tracker.slow_sigma_m->norm() / out.head<3>().norm();
  out.head<3>() = *tracker.slow_sigma_m;
  return out;
}

Vector3d tip_sigma_m(const Calibration& calibration, const FusedConfig& config) {
  if (calibration.tip_sigma_m) return *calibration.tip_sigma_m;
  if (const auto found = calibration.tip_stderr_m()) return *found;
  if (calibration.tip_in_marker_m.isZero(0.0)) return Vector3d::Zero();
  return Vector3d::Constant(config.tip_sigma_m);
}

void set_constants(const Calibration& calibration, bool has_gyro, const FusedConfig& config, Problem& problem) {
  problem.time_sigma = config.tracker_time_sigma_s;
  problem.gate_chi2 = config.gate_chi2;
  problem.accel_bias_psd = std::pow(config.accel_bias_walk_mps2_per_rts, 2);
  problem.gyro_bias_psd =
      std::pow(has_gyro ? config.gyro_bias_walk_radps_per_rts : config.angular_accel_radps2_per_rtHz, 2);
  problem.slow_sigma = slow_sigma(calibration, config);
  problem.slow_time_s = calibration.tracker.slow_time_s.value_or(config.slow_time_s);
  problem.tip_sigma_m = tip_sigma_m(calibration, config);
}

}  // namespace asperity::inertial_smoother
