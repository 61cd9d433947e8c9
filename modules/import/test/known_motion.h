#pragma once

#include <cmath>

#include "asperity/import/body_frame.h"

namespace asperity::testing_import {

// A hand's motion in closed form, world z up: a second of rest, then turns and ways by sines of different frequencies.
inline double begin(double t) { return t < 1.0 ? 0.0 : 1.0 - std::exp(-2.0 * (t - 1.0) * (t - 1.0)); }
inline Eigen::Quaterniond rotation_at(double t) {
  const double a = begin(t);
  return exp_rotation({0.5 * a * std::sin(3.1 * t + 0.2 * t * t), 0.4 * a * std::sin(2.3 * t + 1.0), 0.1}) *
         exp_rotation({0.0, 0.3, 0.7 * a * std::sin(1.7 * t)});
}
inline Eigen::Vector3d position_at(double t) {
  const double a = begin(t);
  return {0.2 + 0.05 * a * std::sin(5.3 * t), 0.04 * a * std::sin(6.1 * t + 1.0), 0.9 + 0.03 * a * std::sin(7.7 * t)};
}

// What sensors of it read, by central differences of 10 µs: rounding stays below 1e-4 rad/s and 1e-3 m/s².
inline Eigen::Vector3d rate_at(double t) {
  constexpr double h = 1e-5;
  return log_rotation(rotation_at(t - h).conjugate() * rotation_at(t + h)) / (2.0 * h);
}
inline Eigen::Vector3d force_at(double t) {
  constexpr double h = 1e-4;
  const Eigen::Vector3d a = (position_at(t + h) - 2.0 * position_at(t) + position_at(t - h)) / (h * h);
  return rotation_at(t).conjugate() * (a + Eigen::Vector3d(0.0, 0.0, 9.81));
}

inline ImportStreams known_motion(double length_s = 12.0, double pose_Hz = 100.0, double imu_Hz = 250.0) {
  ImportStreams out;
  for (int i = 0; i < static_cast<int>(length_s * pose_Hz); ++i) {
    const double t = i / pose_Hz;
    out.pose.t_ns.push_back(std::llround(t * 1e9));
    out.pose.T_world_body.push_back({rotation_at(t), position_at(t)});
  }
  for (int i = 0; i < static_cast<int>(length_s * imu_Hz); ++i) {
    const double t = i / imu_Hz;
    out.specific_force.t_ns.push_back(std::llround(t * 1e9));
    out.specific_force.value.push_back(force_at(t));
    out.rate.t_ns.push_back(std::llround(t * 1e9));
    out.rate.value.push_back(rate_at(t));
  }
  return out;
}

}  // namespace asperity::testing_import
