#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asperity/verdict/verdict.h"

namespace asperity {

// How recording has gone, when it has ended. Messages are of the devices and may be empty.
struct RecordingEvidence {
  // The probe.
  std::uint64_t samples = 0;       // received
  std::uint64_t samples_sent = 0;  // accepted and lost
  std::uint64_t samples_lost = 0;
  bool losses_are_estimated = false;     // from time
  std::uint64_t samples_overflowed = 0;  // did not reach the disk
  std::uint64_t rows_stored = 0;
  std::uint64_t overruns = 0;  // samples that the probe itself dropped, occasions
  std::string sensor_faults;   // what the probe states about its sensors; empty: nothing
  bool columns_missing = false;
  std::string probe_message;
  bool awaits_contact = false;  // stores while the tip touches only
  std::uint64_t touches = 0;
  bool calibrated = true;

  // The tracker.
  bool has_tracker = true;
  std::uint64_t frames = 0;
  std::uint64_t frames_skipped = 0;
  std::uint64_t poses = 0;
  std::uint64_t poses_stored = 0;
  std::uint64_t poses_overflowed = 0;
  std::string tracker_message;
  std::uint64_t frames_not_kept = 0;  // they came faster than they could be written

  // Both.
  struct Source {
    std::string name;
    bool failed = false;
    std::uint64_t lost = 0;  // times that it disappeared
    bool ended = false;
    std::string message;
  };
  std::vector<Source> sources;
  bool gravity_measured = false;
  bool gravity_implausible = false;
};

struct JudgeRecordingConfig {
  double largest_lost_share = 0.01;
  double smallest_seen_share = 0.5;

  template <class V>
  void visit(V& v) {
    v.field("largest_lost_share", largest_lost_share, "lost probe samples above which a recording is invalid",
            {0.0, 1.0});
    v.field("smallest_seen_share", smallest_seen_share, "frames with a pose below which a recording is invalid",
            {0.0, 1.0});
  }
};

// The verdicts on a recording, the worst first.
Verdicts judge_recording(const RecordingEvidence& evidence, const JudgeRecordingConfig& config);

}  // namespace asperity
