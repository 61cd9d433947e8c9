#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "asperity/recording/recording.h"
#include "asperity/recording/recording_appender.h"

namespace asperity {

struct ArrivalConfig {
  double probe_delay_s = 0.0;
  double pose_delay_s = 0.005;

  template <class V>
  void visit(V& v) {
    v.field("probe_delay_s", probe_delay_s, "from a row's time stamp to its arrival, s", {0.0, 10.0});
    v.field("pose_delay_s", pose_delay_s, "from a pose's time stamp to its arrival, s: image processing", {0.0, 10.0});
  }
};

// A row or a pose of a recording, and when it would have arrived.
struct ScanArrival {
  enum class Kind { kRow, kPose };
  Kind kind = Kind::kRow;
  std::size_t index = 0;  // in its stream
  std::int64_t arrival_ns = 0;
};

// All rows and poses of `recording` in the order of their arrival. A time stamp of tracker.csv holds the latency
// already: the pose is stamped that long after its image was taken.
std::vector<ScanArrival> list_arrivals(const Recording& recording, const ArrivalConfig& config = {});

// One row or pose as a sensor would have handed it over. Throws Error for an index beyond the stream.
ProbeSample probe_sample(const ProbeStream& stream, std::size_t index);
TrackerSample tracker_sample(const TrackerStream& stream, std::size_t index);

}  // namespace asperity
