#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/base/problem.h"
#include "asperity/calibration/calibration_verdict.h"

namespace asperity {

// How much later than the probe's samples the tracker's poses are stamped, and what else came out with it.
struct LatencyFit {
  double latency_s = 0.0;  // a pose's true time on the probe's samples' clock is its t_ns minus this
  double latency_error_s = std::numeric_limits<double>::quiet_NaN();  // standard error
  double clock_rate = 0.0;  // how the latency grows, s/s; the latency is that of the recording's middle
  double clock_rate_error = 0.0;
  bool by_gyroscope = true;  // else by the accelerometer

  // What the sensor needed to agree with the tracker, in the marker frame: x_marker = scale · R (x_sensor) − bias.
  bool rotation_solved = false;
  Eigen::Quaterniond R_marker_sensor = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rotation_error_rad = Eigen::Vector3d::Zero();
  bool scale_solved = false;
  double scale = 1.0;
  double scale_error = 0.0;
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();  // rad/s or m/s²
  Eigen::Vector3d bias_error = Eigen::Vector3d::Zero();

  Eigen::Vector3d residual = Eigen::Vector3d::Zero();  // noise of a pose along the world's axes, rad or m
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();     // rad/√s, or m/s/√s: what the integrated sensor drifts by
  double motion = 0.0;                                 // RMS, rad/s or m/s
  std::size_t poses = 0;
  double runner_up_s = std::numeric_limits<double>::quiet_NaN();     // the next best latency; nan: there is none
  double runner_up_ratio = std::numeric_limits<double>::infinity();  // its sum of squares over the best one's
  std::vector<double> scan_latency_s, scan_cost;  // the coarse search: share of the motion that is not explained
  Problems problems;
  CalibrationVerdict verdict;
};

}  // namespace asperity
