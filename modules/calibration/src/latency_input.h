#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/calibration/calibrate_latency.h"

namespace asperity {

// A sensor's samples in one frame, without the rows in which it has none; times in s since the recording's first row.
struct SensorSeries {
  std::vector<double> t_s;
  std::vector<Eigen::Vector3d> x;
  std::vector<std::size_t> gap_after;  // rows after which the next one is too far away to integrate to
};

// The poses whose true time lies between samples at every latency that is sought.
struct PoseSeries {
  std::vector<double> t_s;
  std::vector<Pose> T_world_marker;
  std::vector<std::uint8_t> starts;  // 1 where the probe has a gap since the pose before
};

// Angular rates, rad/s, as the calibration gives them (counts where there is none); or specific forces, m/s².
SensorSeries gyroscope_series(const Recording& recording, const LatencyConfig& config);
SensorSeries accelerometer_series(const Recording& recording, const LatencyConfig& config);

// The variance rate of the sensor's integral by the noise of its samples alone (variance of a sample times the time
// between two), by how far samples are off the fifth-order polynomial through their six neighbours.
double integral_noise_rate(const SensorSeries& sensor);

PoseSeries poses_within(const Recording& recording, const SensorSeries& sensor, const LatencyConfig& config);

// The row of the last sample not after `t_s`, which must lie within the series; `from` is a row not after it to begin
// at.
std::size_t row_before(const std::vector<double>& series_t_s, double t_s, std::size_t from);

}  // namespace asperity
