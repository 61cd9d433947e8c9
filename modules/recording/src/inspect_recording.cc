#include "asperity/recording/inspect_recording.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/units.h"
#include "find_findings.h"
#include "quiet_interval.h"
#include "stream_timing.h"

namespace asperity {

namespace {

template <class ValueOf>
ChannelStatistics channel_statistics(std::string name, const RecordingInfo& info, std::size_t rows,
                                     const std::optional<RowRange>& quiet, ValueOf value_of) {
  ChannelStatistics out;
  out.name = std::move(name);
  const bool range_known = info.adc_max > info.adc_min;
  std::size_t saturated = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double value = value_of(i);
    if (std::isnan(value)) continue;
    out.lowest = out.samples == 0 ? value : std::min(out.lowest, value);
    out.highest = out.samples == 0 ? value : std::max(out.highest, value);
    ++out.samples;
    if (range_known && (value <= info.adc_min || value >= info.adc_max)) ++saturated;
  }
  if (range_known && out.samples > 0) {
    out.saturated_share = static_cast<double>(saturated) / static_cast<double>(out.samples);
  }
  if (!quiet) return out;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = quiet->first; i < quiet->last; ++i) {
    const double value = value_of(i);
    if (std::isnan(value)) continue;
    sum += value;
    count += 1.0;
  }
  if (count < 2.0) return out;
  out.quiet_mean = sum / count;
  double square = 0.0;
  for (std::size_t i = quiet->first; i < quiet->last; ++i) {
    const double value = value_of(i);
    if (!std::isnan(value)) square += (value - out.quiet_mean) * (value - out.quiet_mean);
  }
  out.quiet_noise = std::sqrt(square / (count - 1.0));
  return out;
}

std::vector<ChannelStatistics> all_channels(const Recording& recording, const std::optional<RowRange>& quiet) {
  const ProbeStream& probe = recording.probe;
  std::vector<ChannelStatistics> out;
  const auto add3 = [&](std::initializer_list<const char*> names, const std::vector<Eigen::Vector3d>& values) {
    if (values.empty()) return;
    Eigen::Index axis = 0;
    for (const char* name : names) {
      out.push_back(channel_statistics(name, recording.info, values.size(), quiet,
                                       [&values, axis](std::size_t i) { return values[i][axis]; }));
      ++axis;
    }
  };
  add3({"accel_i", "accel_j", "accel_k"}, probe.accel_counts);
  out.push_back(channel_statistics("force", recording.info, probe.size(), quiet,
                                   [&](std::size_t i) { return probe.force_counts[i]; }));
  add3({"gyro_i", "gyro_j", "gyro_k"}, probe.gyro_counts);
  add3({"force_x", "force_y", "force_z"}, probe.force3_counts);
  return out;
}

// Poses that jump from the last believed one; a jump that lasts is a new place, not a flip.
std::size_t count_flips(const TrackerStream& tracker, double period_s, const InspectConfig& config) {
  constexpr std::size_t kLasting = 5;
  std::size_t flips = 0;
  std::size_t in_a_row = 0;
  std::size_t believed = 0;
  for (std::size_t i = 1; i < tracker.size(); ++i) {
    const Pose& before = tracker.T_world_marker[believed];
    const Pose& now = tracker.T_world_marker[i];
    const double turn_rad = log_rotation(now.rotation * before.rotation.conjugate()).norm();
    const double step_m = (now.translation_m - before.translation_m).norm();
    const double passed_s = static_cast<double>(tracker.t_ns[i] - tracker.t_ns[believed]) * kNanosecond_s;
    const double frames = std::max(passed_s / period_s, 1.0);
    const bool jumps = turn_rad > config.flip_angle_rad * frames || step_m > config.flip_distance_m * frames;
    if (jumps && in_a_row < kLasting) {
      ++flips;
      ++in_a_row;
    } else {
      believed = i;
      in_a_row = 0;
    }
  }
  return flips;
}

std::size_t duplicates_of(const Recording& recording, const char* file) {
  std::size_t count = 0;
  for (const auto& problem : recording.problems) {
    if (problem.kind == "duplicate_time" && problem.message.find(file) != std::string::npos) count += problem.count;
  }
  return count;
}

void measure_force(const Recording& recording, Inspection& out) {
  std::size_t samples = 0;
  for (const double counts : recording.probe.force_counts) {
    if (std::isnan(counts)) continue;
    const double force_N = recording.calibration.force.force_N(counts);
    out.force_lowest_N = samples == 0 ? force_N : std::min(out.force_lowest_N, force_N);
    out.force_highest_N = samples == 0 ? force_N : std::max(out.force_highest_N, force_N);
    ++samples;
  }
  if (samples > 1 && out.probe.duration_s > 0.0)
    out.force_rate_Hz = static_cast<double>(samples - 1) / out.probe.duration_s;
}

}  // namespace

Inspection inspect_recording(const Recording& recording, const InspectConfig& config) {
  Inspection out;
  out.probe = stream_timing(recording.probe.t_ns);
  out.probe.duplicates = duplicates_of(recording, "probe.csv");
  out.tracker = stream_timing(recording.tracker.t_ns);
  out.tracker.duplicates = duplicates_of(recording, "tracker.csv");
  const std::int64_t overlap_ns =
      std::min(out.probe.end_ns, out.tracker.end_ns) - std::max(out.probe.start_ns, out.tracker.start_ns);
  out.overlap_s = static_cast<double>(std::max<std::int64_t>(overlap_ns, 0)) * kNanosecond_s;
  const std::optional<RowRange> quiet = find_quiet_interval(recording.probe, out.probe, config);
  if (quiet) out.quiet = describe_quiet_interval(recording, *quiet, config);
  out.channels = all_channels(recording, quiet);
  measure_force(recording, out);
  out.flips = count_flips(recording.tracker, out.tracker.period_s, config);
  out.findings = find_findings(recording, out, config);
  return out;
}

}  // namespace asperity
