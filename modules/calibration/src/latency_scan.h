#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/calibration/calibrate_latency.h"
#include "latency_input.h"
#include "pose_interpolator.h"

namespace asperity {

// The coarse search: how well the sensor explains the tracker's motion at each latency, the sensor's mean being free,
// and its rotation (Kabsch, 1976) and scale where they are to be solved.
struct LatencyScan {
  std::vector<double> latency_s;
  std::vector<double> cost;  // share of the motion's sum of squares that is left
  std::size_t best = 0;
  bool at_edge = false;
  std::size_t runner_up = 0;  // the next best local minimum; `best` if there is none
  Eigen::Quaterniond R_marker_sensor = Eigen::Quaterniond::Identity();
  double scale = 1.0;
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  double motion = 0.0;  // RMS of what the tracker saw, mean removed: rad/s or m/s²
  std::size_t rows = 0;
};

LatencyScan scan_gyroscope(const SensorSeries& sensor, const PoseSeries& poses, const LatencyConfig& config,
                           bool solve_rotation, bool solve_scale);
LatencyScan scan_accelerometer(const SensorSeries& sensor, const PoseSeries& poses, const PoseInterpolator& tracker,
                               const Eigen::Vector3d& lever_arm_m, const Eigen::Vector3d& gravity_world_mps2,
                               const LatencyConfig& config, bool solve_rotation);

}  // namespace asperity
