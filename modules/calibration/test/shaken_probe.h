#pragma once

#include <cmath>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/recording/recording.h"

namespace asperity::test {

// A hand's shaking: sums of sines of wandering frequencies in rotation vector and position.
struct ShakenProbe {
  double latency_s = 0.0437;
  double length_s = 10.0;
  double tracker_Hz = 60.0, probe_Hz = 200.0;
  double turn_rad = 0.12, move_m = 0.012;               // amplitude of each sine
  Eigen::Vector3d turn_axes = Eigen::Vector3d::Ones();  // how much of the turning is about each
  double regular_Hz = 0.0;                              // above 0: one sine of this frequency alone
  double tracker_sigma_rad = 3.5e-3, tracker_sigma_m = 0.3e-3;
  double gyro_sigma_radps = 0.01, accel_sigma_mps2 = 0.05;
  double clock_rate = 0.0;
  Eigen::Quaterniond R_marker_sensor = Eigen::Quaterniond::Identity();
  Eigen::Vector3d gyro_bias_radps{0.02, -0.01, 0.015};
  Eigen::Vector3d lever_m{0.01, 0.06, -0.02};
  bool gyro = true;
};

class Motion {
 public:
  Motion(Random& random, const ShakenProbe& probe) : probe_(probe) {
    for (auto& axis : waves_) {
      for (Wave& wave : axis) {
        wave.frequency = 6.283185307179586 * (probe.regular_Hz > 0.0 ? probe.regular_Hz : random.uniform(0.8, 3.5));
        wave.phase = random.uniform(0.0, 6.283185307179586);
        wave.amplitude = random.uniform(0.5, 1.0);
      }
    }
  }
  Pose at(double t) const {
    Eigen::Vector3d turn, move;
    for (std::size_t k = 0; k < 3; ++k) {
      turn[static_cast<Eigen::Index>(k)] =
          probe_.turn_rad * probe_.turn_axes[static_cast<Eigen::Index>(k)] * sum(waves_[k], t);
      move[static_cast<Eigen::Index>(k)] = probe_.move_m * sum(waves_[k + 3], t);
    }
    return {exp_rotation(Eigen::Vector3d(0.3, 0.2, -0.4)) * exp_rotation(turn), Eigen::Vector3d(0.0, 0.02, 0.4) + move};
  }
  // In the marker frame, by differences far finer than the motion: errors of 1e-8 of it.
  Eigen::Vector3d rate_radps(double t) const {
    constexpr double h = 1e-5;
    return log_rotation(at(t - h).rotation.conjugate() * at(t + h).rotation) / (2.0 * h);
  }
  Eigen::Vector3d acceleration_mps2(double t, const Eigen::Vector3d& lever_m) const {
    constexpr double h = 1e-3;  // fourth order: (2π 3.5 h)⁴/90 of it
    const auto p = [&](double s) { return Eigen::Vector3d(at(s) * lever_m); };
    return (-p(t - 2 * h) + 16.0 * p(t - h) - 30.0 * p(t) + 16.0 * p(t + h) - p(t + 2 * h)) / (12.0 * h * h);
  }

 private:
  struct Wave {
    double frequency = 0.0, phase = 0.0, amplitude = 0.0;
  };
  using Waves = std::array<Wave, 4>;
  double sum(const Waves& waves, double t) const {
    double out = 0.0;
    const std::size_t count = probe_.regular_Hz > 0.0 ? 1 : waves.size();
    for (std::size_t i = 0; i < count; ++i)
      out += waves[i].amplitude * std::sin(waves[i].frequency * t + waves[i].phase);
    return out;
  }
  const ShakenProbe& probe_;
  std::array<Waves, 6> waves_;
};

inline Recording shake(Random& random, const ShakenProbe& probe) {
  const Motion motion(random, probe);
  Recording out;
  out.info.gravity_world_mps2 = {0.0, 9.81, 0.0};
  out.calibration.accelerometer.B = 200.0 * probe.R_marker_sensor.conjugate().toRotationMatrix();
  out.calibration.accelerometer.C = {5.0, -3.0, 2.0};
  out.calibration.accelerometer.position_in_marker_m = probe.lever_m;
  out.calibration.gyroscope =
      GyroscopeCalibration{900.0 * probe.R_marker_sensor.conjugate().toRotationMatrix(), {1.0, 2.0, 3.0}};
  constexpr std::int64_t kStart_ns = 5'000'000'000;
  for (double t = 0.0; t < probe.length_s; t += 1.0 / probe.probe_Hz) {
    out.probe.t_ns.push_back(kStart_ns + static_cast<std::int64_t>(1e9 * t));
    const double at = static_cast<double>(out.probe.t_ns.back() - kStart_ns) * 1e-9;
    const auto noise = [&](double sigma) {
      return Eigen::Vector3d(sigma * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
    };
    const Eigen::Vector3d f = motion.at(at).rotation.conjugate() *
                              (motion.acceleration_mps2(at, probe.lever_m) - out.info.gravity_world_mps2);
    out.probe.accel_counts.push_back(out.calibration.accelerometer.counts(f + noise(probe.accel_sigma_mps2)));
    out.probe.force_counts.push_back(0.0);
    if (!probe.gyro) continue;
    const Eigen::Vector3d w = motion.rate_radps(at) + probe.gyro_bias_radps + noise(probe.gyro_sigma_radps);
    out.probe.gyro_counts.push_back(out.calibration.gyroscope->B * w + out.calibration.gyroscope->C);
  }
  for (double t = 0.0; t < probe.length_s; t += random.uniform(0.9, 1.1) / probe.tracker_Hz) {
    const Pose true_pose = motion.at(t);
    const double stamp_s = t + probe.latency_s + probe.clock_rate * (t - 0.5 * probe.length_s);
    out.tracker.t_ns.push_back(kStart_ns + static_cast<std::int64_t>(std::llround(1e9 * stamp_s)));
    const Eigen::Vector3d turn(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3d move(random.normal(), random.normal(), 3.0 * random.normal());
    out.tracker.T_world_marker.push_back({exp_rotation(probe.tracker_sigma_rad * turn) * true_pose.rotation,
                                          true_pose.translation_m + probe.tracker_sigma_m * move});
  }
  return out;
}

}  // namespace asperity::test
