#include "information_bound.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"
#include "asperity/simulation/tracker_sampler.h"

namespace bench {

namespace {

using asperity::skew;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kP = 0, kV = 3, kPhi = 6, kBa = 9, kBg = 12, kLatency = 15, kLever = 16, kSize = 19;
using Square = Eigen::Matrix<double, kSize, kSize>;

// The truth at one row, with what is derived from it by differences.
struct Row {
  double t_s;
  Matrix3d R;
  Vector3d A;      // specific force at the accelerometer, world
  Vector3d omega;  // world
  Vector3d v_marker;
};

std::vector<Row> rows_of(const asperity::Recording& recording, const Vector3d& sensor, const Vector3d& tip) {
  const asperity::Truth& truth = *recording.truth;
  std::vector<Row> out;
  const auto t_s = [&](std::size_t i) { return 1e-9 * static_cast<double>(truth.t_ns[i] - truth.t_ns[0]); };
  const auto at = [&](std::size_t i, const Vector3d& place) -> Vector3d {
    return truth.p_world_tip_m[i] + truth.q_world_marker[i] * (place - tip);
  };
  for (std::size_t i = 1; i + 1 < truth.size(); ++i) {
    const double h0 = t_s(i) - t_s(i - 1), h1 = t_s(i + 1) - t_s(i);
    const Vector3d slope0 = (at(i, sensor) - at(i - 1, sensor)) / h0, slope1 = (at(i + 1, sensor) - at(i, sensor)) / h1;
    Row row;
    row.t_s = t_s(i);
    row.R = truth.q_world_marker[i].toRotationMatrix();
    row.A = 2.0 * (slope1 - slope0) / (h0 + h1) - recording.info.gravity_world_mps2;
    row.omega =
        asperity::log_rotation(truth.q_world_marker[i + 1] * truth.q_world_marker[i - 1].conjugate()) / (h0 + h1);
    row.v_marker = (at(i + 1, Vector3d::Zero()) - at(i - 1, Vector3d::Zero())) / (h0 + h1);
    out.push_back(row);
  }
  return out;
}

Square prior(const asperity::SimulationConfig& config, double gravity_mps2) {
  const asperity::SimulatedCalibrationConfig& c = config.calibration;
  const double k = c.imperfection;
  Square P = Square::Zero();
  const auto set = [&](int at, double sigma) { P.diagonal().segment<3>(at).setConstant(sigma * sigma); };
  constexpr double kLeast = 1e-9;  // what is exact stays invertible
  set(kP, 1.0);
  set(kV, 1.0);
  set(kPhi, 1.0);
  // Scale and gravity's direction act on gravity as a bias does.
  set(kBa, std::max(kLeast, k * std::hypot(c.accel_bias_mps2, gravity_mps2 * c.accel_scale,
                                           gravity_mps2 * c.gravity_direction_rad)));
  set(kBg, std::max(kLeast, config.probe.gyroscope ? k * c.gyro_bias_radps : 0.0));
  P(kLatency, kLatency) = std::pow(std::max(kLeast, k * c.latency_s), 2);
  set(kLever, std::max(kLeast, k * c.sensor_m));
  return P;
}

// Density of white noise that rounding to counts and the sensor's own have together.
double density2(double noise_per_rtHz, bool quantised, const Matrix3d& counts_per_unit, double rate_Hz) {
  const double scale = std::cbrt(std::abs(counts_per_unit.determinant()));
  return noise_per_rtHz * noise_per_rtHz + (quantised ? 1.0 / (12.0 * scale * scale * rate_Hz) : 0.0);
}

struct Epoch {
  Square P;          // after the pose
  Square predicted;  // before the next
  Square Phi;        // to the next
  Eigen::Matrix<double, 3, kSize> J;
};

}  // namespace

double position_bound_m(const asperity::Recording& recording, const asperity::SimulationConfig& config) {
  const Vector3d sensor(config.probe.sensor_in_marker_m.data()), tip(config.probe.tip_in_marker_m.data());
  const std::vector<Row> rows = rows_of(recording, sensor, tip);
  const double rate_Hz = config.probe.true_rate_Hz;
  const double accel2 = density2(config.probe.accel_noise_mps2_per_rtHz, config.probe.quantise,
                                 recording.calibration.accelerometer.B.leftCols<3>(), rate_Hz);
  const double gyro2 = recording.calibration.gyroscope
                           ? density2(config.probe.gyro_noise_radps_per_rtHz, config.probe.quantise,
                                      recording.calibration.gyroscope->B, rate_Hz)
                           : 0.0;
  const double start_s = 1e-9 * static_cast<double>(recording.truth->t_ns[0]);
  std::vector<double> pose_s;
  for (const std::int64_t t_ns : recording.tracker.t_ns) {
    pose_s.push_back(1e-9 * static_cast<double>(t_ns) - config.tracker.latency_s - start_s);
  }

  std::vector<Epoch> epochs;
  Square P = prior(config, recording.info.gravity_world_mps2.norm());
  Square Phi = Square::Identity();
  Square Q = Square::Zero();
  std::size_t pose = 0;
  while (pose < pose_s.size() && pose_s[pose] < rows.front().t_s) ++pose;
  for (std::size_t i = 0; i + 1 < rows.size() && pose < pose_s.size(); ++i) {
    const Row& row = rows[i];
    const double dt = rows[i + 1].t_s - row.t_s;
    if (pose_s[pose] <= row.t_s + 0.5 * dt) {
      P = (Phi * P * Phi.transpose() + Q).eval();
      if (!epochs.empty()) {
        epochs.back().predicted = P;
        epochs.back().Phi = Phi;
      }
      Phi.setIdentity();
      Q.setZero();
      const Vector3d arm = row.R * sensor;
      Eigen::Matrix<double, 6, kSize> H = Eigen::Matrix<double, 6, kSize>::Zero();
      H.block<3, 3>(0, kP).setIdentity();
      H.block<3, 3>(0, kPhi) = skew(arm);
      H.block<3, 1>(0, kLatency) = -row.v_marker;
      H.block<3, 3>(0, kLever) = -row.R;
      H.block<3, 3>(3, kPhi).setIdentity();
      H.block<3, 1>(3, kLatency) = -row.omega;
      const asperity::Pose T{Eigen::Quaterniond(row.R), recording.truth->p_world_tip_m[i + 1] - row.R * tip};
      const auto noise = asperity::simulated_tracker_noise(config.tracker, T);
      const auto in_world = [&](const Vector3d& sigma) -> Matrix3d {
        return noise.world_from_ray * sigma.cwiseAbs2().asDiagonal() * noise.world_from_ray.transpose();
      };
      Eigen::Matrix<double, 6, 6> S = H * P * H.transpose();
      S.topLeftCorner<3, 3>() += in_world(noise.position_m);
      S.bottomRightCorner<3, 3>() += in_world(noise.rotation_rad);
      const Eigen::Matrix<double, kSize, 6> K = S.ldlt().solve(H * P).transpose();
      P -= K * H * P;
      P = (0.5 * (P + P.transpose())).eval();
      Epoch epoch;
      epoch.P = P;
      epoch.J.setZero();
      epoch.J.block<3, 3>(0, kP).setIdentity();
      epoch.J.block<3, 3>(0, kPhi) = -skew(row.R * (tip - sensor));
      epoch.J.block<3, 3>(0, kLever) = -row.R;
      epochs.push_back(epoch);
      while (pose < pose_s.size() && pose_s[pose] <= row.t_s + 0.5 * dt) ++pose;
    }
    Square step = Square::Identity();
    step.block<3, 3>(kP, kV).diagonal().setConstant(dt);
    step.block<3, 3>(kV, kPhi) = -dt * skew(row.A);
    step.block<3, 3>(kP, kPhi) = -0.5 * dt * dt * skew(row.A);
    step.block<3, 3>(kV, kBa) = -dt * row.R;
    step.block<3, 3>(kP, kBa) = -0.5 * dt * dt * row.R;
    step.block<3, 3>(kPhi, kBg) = -dt * row.R;
    Q = (step * Q * step.transpose()).eval();
    for (int k = 0; k < 3; ++k) {
      Q(kV + k, kV + k) += accel2 * dt;
      Q(kP + k, kV + k) += 0.5 * accel2 * dt * dt;
      Q(kV + k, kP + k) += 0.5 * accel2 * dt * dt;
      Q(kP + k, kP + k) += accel2 * dt * dt * dt / 3.0;
      Q(kPhi + k, kPhi + k) += gyro2 * dt;
    }
    Phi = (step * Phi).eval();
  }
  if (epochs.size() < 2) throw asperity::Error("information bound: too few poses");
  const double tip_m2 = 3.0 * std::pow(config.calibration.imperfection * config.calibration.tip_m, 2);
  double sum_m2 = 0.0;
  Square smoothed = epochs.back().P;
  for (std::size_t e = epochs.size(); e-- > 0;) {
    if (e + 1 < epochs.size()) {
      const Epoch& epoch = epochs[e];
      const Square C = epoch.predicted.ldlt().solve(epoch.Phi * epoch.P).transpose();
      smoothed = (epoch.P + C * (smoothed - epoch.predicted) * C.transpose()).eval();
    }
    sum_m2 += (epochs[e].J * smoothed * epochs[e].J.transpose()).trace() + tip_m2;
  }
  return std::sqrt(sum_m2 / static_cast<double>(epochs.size()));
}

}  // namespace bench
