#include "unfinished.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "asperity/base/text.h"

namespace asperity {

namespace {

// A segment may have begun that recording.json did not yet know of.
void add_unlisted(Recording& recording, const RecorderState& recorder, std::int64_t last_row_ns) {
  constexpr std::int64_t kOverhang_ns = 200'000'000;  // rows that a segment may have behind its end
  std::int64_t known_ns = std::numeric_limits<std::int64_t>::min();
  for (const Segment& segment : recording.info.segments) known_ns = std::max(known_ns, segment.end_ns);
  if (recorder.discarded_until_ns) known_ns = std::max(known_ns, *recorder.discarded_until_ns);
  const auto& t_ns = recording.probe.t_ns;
  const auto first = std::upper_bound(t_ns.begin(), t_ns.end(), known_ns);
  if (first == t_ns.end() || last_row_ns - *first < kOverhang_ns) return;
  recording.info.segments.push_back({"unfinished", *first, last_row_ns});
}

// The names of those whose rows are still there; "" if there are none.
std::string discarded_names(const RecorderState& recorder) {
  constexpr std::size_t kMostNamed = 5;
  std::string out;
  std::size_t count = 0;
  for (const Segment& each : recorder.discarded) {
    if (count++ < kMostNamed) out += (out.empty() ? "" : ", ") + printable(each.name, 100);
  }
  return count > kMostNamed ? out + ", …" : out;
}

}  // namespace

void close_unfinished(Recording& recording) {
  if (!recording.info.recorder || recording.info.recorder->state != "recording") return;
  const RecorderState& recorder = *recording.info.recorder;
  recording.problems.push_back({"unfinished", "the recorder was interrupted; the data that it had stored are kept"});
  if (const std::string names = discarded_names(recorder); !names.empty()) {
    recording.problems.push_back({"discarded_rows", "rows of segments that were discarded are still in its files: " +
                                                        names + " (recording.json, extra.recorder.discarded)"});
  }
  std::int64_t last_row_ns = std::numeric_limits<std::int64_t>::min();
  if (recording.probe.size() > 0) last_row_ns = std::max(last_row_ns, recording.probe.t_ns.back());
  if (recording.tracker.size() > 0) last_row_ns = std::max(last_row_ns, recording.tracker.t_ns.back());
  for (const TrackerStream& poses : recording.body_poses) {
    if (poses.size() > 0) last_row_ns = std::max(last_row_ns, poses.t_ns.back());
  }
  std::vector<Segment>& segments = recording.info.segments;
  if (recorder.last_segment_is_open.value_or(false) && !segments.empty()) {
    segments.back().end_ns = std::max(segments.back().end_ns, last_row_ns);
    return;
  }
  add_unlisted(recording, recorder, last_row_ns);
}

}  // namespace asperity
