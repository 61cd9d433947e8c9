#include "unfinished.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace asperity {

void close_unfinished(Recording& recording) {
  const auto extra = nlohmann::json::parse(recording.info.extra_json, nullptr, false);
  if (!extra.is_object() || !extra.contains("recorder") || !extra["recorder"].is_object()) return;
  const auto& recorder = extra["recorder"];
  if (!recorder.contains("state") || recorder["state"] != "recording") return;
  recording.problems.push_back({"unfinished", "the recorder did not come to its end; what it had stored is there"});
  const bool open = recorder.contains("last_segment_is_open") && recorder["last_segment_is_open"] == true;
  if (!open || recording.info.segments.empty()) return;
  Segment& last = recording.info.segments.back();
  if (recording.probe.size() > 0) last.end_ns = std::max(last.end_ns, recording.probe.t_ns.back());
  if (recording.tracker.size() > 0) last.end_ns = std::max(last.end_ns, recording.tracker.t_ns.back());
}

}  // namespace asperity
