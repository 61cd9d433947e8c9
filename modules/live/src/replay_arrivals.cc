#include "asperity/live/replay_arrivals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "asperity/base/error.h"

namespace asperity {

std::vector<ScanArrival> list_arrivals(const Recording& recording, const ArrivalConfig& config) {
  const std::int64_t row_ns = std::llround(config.probe_delay_s * 1e9);
  const std::int64_t pose_ns = std::llround(config.pose_delay_s * 1e9);
  std::vector<ScanArrival> out;
  out.reserve(recording.probe.size() + recording.tracker.size());
  for (std::size_t i = 0; i < recording.probe.size(); ++i) {
    out.push_back({ScanArrival::Kind::kRow, i, recording.probe.t_ns[i] + row_ns});
  }
  for (std::size_t i = 0; i < recording.tracker.size(); ++i) {
    out.push_back({ScanArrival::Kind::kPose, i, recording.tracker.t_ns[i] + pose_ns});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const ScanArrival& a, const ScanArrival& b) { return a.arrival_ns < b.arrival_ns; });
  return out;
}

ProbeSample probe_sample(const ProbeStream& stream, std::size_t index) {
  if (index >= stream.size()) throw Error("probe stream: no row " + std::to_string(index));
  ProbeSample out;
  out.t_ns = stream.t_ns[index];
  out.accel_counts = stream.accel_counts[index];
  out.force_counts =
      stream.force_counts.empty() ? std::numeric_limits<double>::quiet_NaN() : stream.force_counts[index];
  if (!stream.gyro_counts.empty()) out.gyro_counts = stream.gyro_counts[index];
  if (!stream.force3_counts.empty()) out.force3_counts = stream.force3_counts[index];
  return out;
}

TrackerSample tracker_sample(const TrackerStream& stream, std::size_t index) {
  if (index >= stream.size()) throw Error("tracker stream: no pose " + std::to_string(index));
  TrackerSample out;
  out.t_ns = stream.t_ns[index];
  out.T_world_marker = stream.T_world_marker[index];
  if (!stream.markers.empty()) out.markers = stream.markers[index];
  if (!stream.reprojection_px.empty()) out.reprojection_px = stream.reprojection_px[index];
  if (!stream.sigma_position_m.empty()) out.sigma_position_m = stream.sigma_position_m[index];
  if (!stream.sigma_rotation_rad.empty()) out.sigma_rotation_rad = stream.sigma_rotation_rad[index];
  if (!stream.noise_position_m.empty()) out.noise_position_m = stream.noise_position_m[index];
  if (!stream.noise_rotation_rad.empty()) out.noise_rotation_rad = stream.noise_rotation_rad[index];
  return out;
}

}  // namespace asperity
