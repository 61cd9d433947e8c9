#pragma once

#include <cmath>
#include <cstdint>

#include "asperity/base/random.h"
#include "asperity/recording/recording.h"

namespace asperity::testing_motion {

// A hand that draws a probe over a surface, in closed form but for derivatives by central differences:
// an oracle for the trajectory stage that shares no code with it or with the virtual bench.
struct HandMotion {
  double speed_mps = 0.025;
  double texture_m = 50e-6;  // amplitude
  double texture_Hz = 20.0;
  double wander_rad = 0.05;

  Eigen::Vector3d tip(double t) const {
    // A rest of half a second, then the stroke with a soft start.
    const double u = std::max(0.0, t - 0.5);
    const double along = speed_mps * (u - std::tanh(4.0 * u) / 4.0);
    const double fade = std::tanh(2.0 * u);
    return {along + 0.001 * fade * std::sin(1.7 * u), -0.02 + fade * texture_m * std::sin(2.0 * M_PI * texture_Hz * u),
            0.35 + 0.002 * fade * std::sin(0.9 * u)};
  }
  Eigen::Quaterniond orientation(double t) const {
    const Eigen::Vector3d phi(0.1 + wander_rad * std::sin(1.1 * t), 0.5 * wander_rad * std::sin(0.7 * t + 1.0),
                              wander_rad * std::sin(1.6 * t + 2.0) + 0.001 * std::sin(2.0 * M_PI * 9.0 * t));
    return exp_rotation(phi);
  }
};

// A hand that takes the probe through the air with rests: a closed-form motion along a time of its own, which stands
// still while the hand rests.
struct RestingHand {
  double phase = 0.0;
  double turn_rad = 0.4;

  double own_time(double t) const {
    constexpr double kSteep = 6.0;  // 1/s
    const auto ramp = [&](double x) { return 0.5 * (x + std::log(2.0 * std::cosh(kSteep * x)) / kSteep); };
    return ramp(t - 3.0) - ramp(t - 7.0) + ramp(t - 8.5) - ramp(t - 12.5);
  }
  Eigen::Vector3d tip(double t) const {
    const double u = own_time(t);
    return {0.08 * std::sin(2.1 * u + phase),
            -0.02 + 0.05 * std::sin(3.3 * u + 2.0 * phase) + 0.01 * std::sin(11.0 * u),
            0.35 + 0.06 * std::cos(1.7 * u - phase)};
  }
  Eigen::Quaterniond orientation(double t) const {
    const double u = own_time(t);
    const Eigen::Vector3d phi(0.1 + turn_rad * std::sin(1.9 * u + phase), turn_rad * std::sin(1.3 * u + 1.0),
                              0.7 * turn_rad * std::sin(2.6 * u - phase));
    return exp_rotation(phi);
  }
};

struct Sensors {
  double duration_s = 4.0;
  double rate_Hz = 4000.0;
  bool gyro = true;
  double accel_noise_mps2 = 0.03;
  double gyro_noise_radps = 0.002;
  Eigen::Vector3d accel_bias{0.05, -0.03, 0.04};
  Eigen::Vector3d gyro_bias{0.004, -0.003, 0.002};
  Eigen::Matrix3d accel_matrix = Eigen::Matrix3d::Identity();  // what the calibration does not know of
  Eigen::Matrix3d gyro_matrix = Eigen::Matrix3d::Identity();
  double tracker_jitter_s = 0.0;    // of a pose's stamp
  double counts_per_mps2 = 208.7;   // 16 bit over ±16 g
  double counts_per_radps = 938.7;  // 16 bit over ±2000 °/s
  double tracker_rate_Hz = 120.0;
  Eigen::Vector3d tracker_sigma_m{0.15e-3, 0.13e-3, 0.54e-3};
  double tracker_rotation_sigma_rad = 4e-3;
  double latency_s = 0.012;
  double latency_prior_s = 0.010;
  double flip_share = 0.0;
  Eigen::Vector3d tip_in_marker{0.0, 0.10, 0.01};
  Eigen::Vector3d accel_in_marker{0.005, 0.03, 0.0};
  std::uint64_t seed = 1;
};

template <class Hand>
Recording record(const Hand& hand, const Sensors& sensors) {
  Recording rec;
  const Eigen::Vector3d gravity(0.0, 9.80665, 0.0);
  rec.info.gravity_world_mps2 = gravity;
  rec.info.adc_min = -32768;
  rec.info.adc_max = 32767;
  rec.info.probe_rate_Hz = sensors.rate_Hz;
  rec.info.tracker_rate_Hz = sensors.tracker_rate_Hz;
  Calibration& c = rec.calibration;
  c.accelerometer.B = Eigen::Matrix3d::Identity() * sensors.counts_per_mps2;
  c.accelerometer.position_in_marker_m = sensors.accel_in_marker;
  if (sensors.gyro)
    c.gyroscope = GyroscopeCalibration{Eigen::Matrix3d::Identity() * sensors.counts_per_radps, Eigen::Vector3d::Zero()};
  c.tip_in_marker_m = sensors.tip_in_marker;
  c.tip_sigma_m = Eigen::Vector3d::Zero();  // exact, and stated so
  c.tracker.slow_sigma_m = Eigen::Vector3d::Zero();
  c.tracker.sigma_position_m = sensors.tracker_sigma_m;
  c.tracker.sigma_rotation_rad.setConstant(sensors.tracker_rotation_sigma_rad);
  c.tracker.latency_s = sensors.latency_prior_s;
  c.tracker.latency_sigma_s = 0.004;
  Random noise(sensors.seed, 1);
  const auto three = [&](Random& r, double sigma) -> Eigen::Vector3d {
    return sigma * Eigen::Vector3d(r.normal(), r.normal(), r.normal());
  };
  constexpr double kStep_s = 1e-4;
  const auto accel_point = [&](double t) -> Eigen::Vector3d {
    return hand.tip(t) + hand.orientation(t) * (sensors.accel_in_marker - sensors.tip_in_marker);
  };
  const auto rounded = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return x.array().round().max(-32768).min(32767);
  };
  const auto count = static_cast<int>(sensors.duration_s * sensors.rate_Hz);
  for (int i = 0; i < count; ++i) {
    const double t = 0.1 + i / sensors.rate_Hz;
    const Eigen::Quaterniond q = hand.orientation(t);
    const Eigen::Vector3d a =
        (accel_point(t + kStep_s) - 2.0 * accel_point(t) + accel_point(t - kStep_s)) / (kStep_s * kStep_s);
    const Eigen::Vector3d omega =
        q.conjugate() *
        (log_rotation(hand.orientation(t + kStep_s) * hand.orientation(t - kStep_s).conjugate()) / (2.0 * kStep_s));
    const Eigen::Vector3d f = sensors.accel_matrix * (q.conjugate() * (a - gravity)) + sensors.accel_bias +
                              three(noise, sensors.accel_noise_mps2);
    rec.probe.t_ns.push_back(std::llround(t * 1e9));
    rec.probe.accel_counts.push_back(rounded(f * sensors.counts_per_mps2));
    if (sensors.gyro)
      rec.probe.gyro_counts.push_back(
          rounded((sensors.gyro_matrix * omega + sensors.gyro_bias + three(noise, sensors.gyro_noise_radps)) *
                  sensors.counts_per_radps));
    rec.probe.force_counts.push_back(1.0);
  }
  Random tracker(sensors.seed, 2);
  for (double t = 0.1; t < 0.1 + sensors.duration_s; t += 1.0 / sensors.tracker_rate_Hz) {
    Pose pose;
    const Eigen::Quaterniond q = hand.orientation(t);
    pose.translation_m = hand.tip(t) - q * sensors.tip_in_marker;
    pose.translation_m +=
        Eigen::Vector3d(tracker.normal(), tracker.normal(), tracker.normal()).cwiseProduct(sensors.tracker_sigma_m);
    pose.rotation = exp_rotation(three(tracker, sensors.tracker_rotation_sigma_rad)) * q;
    if (tracker.chance(sensors.flip_share)) {
      pose.rotation = exp_rotation(Eigen::Vector3d(0.0, 0.8, 0.3)) * pose.rotation;
      pose.translation_m += Eigen::Vector3d(0.001, 0.002, 0.01);
    }
    const double late_s = sensors.tracker_jitter_s > 0.0 ? sensors.tracker_jitter_s * tracker.normal() : 0.0;
    rec.tracker.t_ns.push_back(std::llround((t + sensors.latency_s + late_s) * 1e9));
    rec.tracker.T_world_marker.push_back(pose);
  }
  return rec;
}

}  // namespace asperity::testing_motion
