#include "latency_input.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/units.h"

namespace asperity {

namespace {

double since_start_s(const Recording& recording, std::int64_t t_ns) {
  return static_cast<double>(t_ns - recording.probe.t_ns.front()) * kNanosecond_s;
}

template <class ValueOf>
SensorSeries series_of(const Recording& recording, const LatencyConfig& config, ValueOf value_of) {
  SensorSeries out;
  for (std::size_t i = 0; i < recording.probe.size(); ++i) {
    const Eigen::Vector3d value = value_of(i);
    if (!value.allFinite()) continue;
    const double t_s = since_start_s(recording, recording.probe.t_ns[i]) - recording.calibration.probe_latency_s;
    if (!out.t_s.empty() && t_s - out.t_s.back() > config.largest_gap_s) out.gap_after.push_back(out.t_s.size() - 1);
    out.t_s.push_back(t_s);
    out.x.push_back(value);
  }
  return out;
}

}  // namespace

SensorSeries gyroscope_series(const Recording& recording, const LatencyConfig& config) {
  const auto& gyroscope = recording.calibration.gyroscope;
  const Eigen::Matrix3d inverse = gyroscope ? Eigen::Matrix3d(gyroscope->B.inverse()) : Eigen::Matrix3d::Identity();
  const Eigen::Vector3d offset = gyroscope ? gyroscope->C : Eigen::Vector3d::Zero();
  return series_of(recording, config, [&](std::size_t i) -> Eigen::Vector3d {
    return inverse * (recording.probe.gyro_counts[i] - offset);
  });
}

SensorSeries accelerometer_series(const Recording& recording, const LatencyConfig& config) {
  return series_of(recording, config, [&](std::size_t i) -> Eigen::Vector3d {
    return recording.calibration.accelerometer.specific_force_mps2(recording.probe.accel_counts[i]);
  });
}

double integral_noise_rate(const SensorSeries& sensor) {
  constexpr std::size_t kSide = 3;
  double sum = 0.0, count = 0.0, step_s = 0.0;
  std::size_t gap = 0;
  for (std::size_t i = kSide; i + kSide < sensor.x.size(); ++i) {
    while (gap < sensor.gap_after.size() && sensor.gap_after[gap] + kSide < i) ++gap;
    if (gap < sensor.gap_after.size() && sensor.gap_after[gap] < i + kSide) continue;
    Eigen::Vector3d off = sensor.x[i];
    double gain = 1.0;
    for (std::size_t j = i - kSide; j <= i + kSide; ++j) {
      if (j == i) continue;
      double weight = 1.0;
      for (std::size_t k = i - kSide; k <= i + kSide; ++k) {
        if (k != j && k != i) weight *= (sensor.t_s[i] - sensor.t_s[k]) / (sensor.t_s[j] - sensor.t_s[k]);
      }
      off -= weight * sensor.x[j];
      gain += weight * weight;
    }
    sum += off.squaredNorm() / (3.0 * gain);
    step_s += sensor.t_s[i + 1] - sensor.t_s[i];
    count += 1.0;
  }
  return count > 0.0 ? sum / count * step_s / count : 0.0;
}

PoseSeries poses_within(const Recording& recording, const SensorSeries& sensor, const LatencyConfig& config) {
  PoseSeries out;
  if (sensor.t_s.size() < 2) return out;
  std::size_t run = 0;  // gaps that lie behind
  bool new_run = true;
  for (std::size_t i = 0; i < recording.tracker.size(); ++i) {
    const double t_s = since_start_s(recording, recording.tracker.t_ns[i]);
    const double first_s = t_s - config.largest_latency_s, last_s = t_s - config.least_latency_s;
    if (!(first_s > sensor.t_s.front() && last_s < sensor.t_s.back())) continue;
    while (run < sensor.gap_after.size() && sensor.t_s[sensor.gap_after[run] + 1] <= first_s) {
      ++run;
      new_run = true;
    }
    if (run < sensor.gap_after.size() && sensor.t_s[sensor.gap_after[run]] < last_s) continue;
    out.t_s.push_back(t_s);
    out.T_world_marker.push_back(recording.tracker.T_world_marker[i]);
    out.starts.push_back(new_run ? 1 : 0);
    new_run = false;
  }
  return out;
}

std::size_t row_before(const std::vector<double>& series_t_s, double t_s, std::size_t from) {
  std::size_t row = from;
  while (row + 2 < series_t_s.size() && series_t_s[row + 1] <= t_s) ++row;
  return row;
}

}  // namespace asperity
