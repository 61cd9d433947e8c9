#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "asperity/recorder/recorder_snapshot.h"

namespace asperity {

// What the sensors and queues have lost, as counts for recording.json (docs/recorder.md); zeros are left out.
inline std::map<std::string, std::int64_t> sensor_problems(const RecorderSnapshot& now) {
  std::map<std::string, std::int64_t> out;
  const auto count = [&](const char* name, std::uint64_t value) {
    if (value > 0) out[name] = static_cast<std::int64_t>(value);
  };
  count(now.link.losses_are_estimated ? "probe_lost_samples_estimated" : "probe_lost_samples", now.link.lost_samples);
  count(now.link.losses_are_estimated ? "probe_lost_frames_estimated" : "probe_lost_frames", now.link.lost_frames);
  count("probe_damaged_frames", now.link.damaged_frames);
  count("probe_late_frames", now.link.late_frames);
  count("probe_resyncs", now.link.resyncs);
  count("probe_restarts", now.link.restarts);
  count("probe_overruns", now.link.overruns);
  count("probe_queue_overflow", now.probe.overflowed);
  count("probe_disappeared", now.probe.lost);
  count("tracker_skipped_frames", now.tracking.skipped_frames);
  count("tracker_queue_overflow", now.poses.overflowed);
  count("tracker_disappeared", now.poses.lost);
  return out;
}

}  // namespace asperity
