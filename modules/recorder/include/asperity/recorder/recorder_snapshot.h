#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "asperity/link/link_statistics.h"
#include "asperity/link/probe_description.h"
#include "asperity/recorder/gravity_estimator.h"
#include "asperity/recording/recording_appender.h"
#include "asperity/tracking/pose_source.h"

namespace asperity {

enum class SensorState {
  kAbsent,   // not asked for
  kRunning,  // data come
  kSilent,   // open, but nothing has come yet
  kLost,     // gone; opened again and again
  kEnded     // came to its end; not to be opened again
};

struct SensorSnapshot {
  SensorState state = SensorState::kAbsent;
  std::string name;
  std::vector<std::string> warnings;  // of how it is set up, as the sensor says them
  std::string message;         // why it is lost or has ended, as the system says it: escape it where it is printed
  bool failed = false;         // it has ended by a fault, such as an image that cannot be read, before its end
  std::uint64_t lost = 0;      // times
  std::uint64_t returned = 0;  // times
  double rate_Hz = 0.0;        // rows in the last second
  std::uint64_t received = 0;  // rows
  double queue_fill = 0.0;     // share
  double highest_queue_fill = 0.0;
  std::uint64_t overflowed = 0;  // rows dropped because the queue was full
};

// A body that is tracked in addition to the probe's.
struct BodySnapshot {
  std::string name;
  std::uint64_t rows = 0;             // written
  std::optional<TrackerSample> pose;  // newest
  double pose_age_s = std::numeric_limits<double>::quiet_NaN();
};

// The state of a running recording, all of one moment.
struct RecorderSnapshot {
  double running_s = 0.0;
  SensorSnapshot probe;
  SensorSnapshot poses;
  LinkStatistics link;          // over all times that the probe was opened
  TrackingStatistics tracking;  // likewise
  std::optional<ProbeDescription> description;
  bool columns_missing = false;  // it described itself too late: it has sensors that are not stored

  double force_N = std::numeric_limits<double>::quiet_NaN();  // newest; counts if not calibrated
  bool force_is_calibrated = false;
  bool touching = false;
  bool contact_ready = false;  // false: the idle level is still being taken
  std::uint64_t touches = 0;
  std::optional<TrackerSample> pose;  // newest
  double pose_age_s = std::numeric_limits<double>::quiet_NaN();
  std::vector<BodySnapshot> bodies;

  bool storing = false;
  std::string segment;  // the open one, or the last
  std::size_t segments = 0;
  std::vector<Segment> segment_list;  // the open one too, which ends at the newest row
  bool automatic = false;             // segments start and stop by themselves
  std::size_t discarded = 0;          // less those that were brought back
  std::size_t restored = 0;
  std::optional<Segment> last_discarded;  // what restore_segment() brings back; nullopt: there is nothing
  double recorded_s = 0.0;
  std::uint64_t probe_rows = 0;  // written
  std::uint64_t tracker_rows = 0;
  std::uint64_t disk_bytes = 0;
  double highest_write_s = 0.0;  // longest time that the disk took for one batch

  GravityEstimate gravity;
  std::string failure;  // why nothing can be stored any more; empty: nothing is wrong
};

}  // namespace asperity
