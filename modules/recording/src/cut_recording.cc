#include "asperity/recording/cut_recording.h"

#include <algorithm>
#include <set>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::int64_t kJoinedGap_ns = 100'000'000;

struct Rows {
  std::size_t first = 0;
  std::size_t last = 0;  // exclusive
};

Rows rows_between(const std::vector<std::int64_t>& t_ns, std::int64_t start_ns, std::int64_t end_ns) {
  const auto first = std::lower_bound(t_ns.begin(), t_ns.end(), start_ns);
  const auto last = std::upper_bound(first, t_ns.end(), end_ns);
  return {static_cast<std::size_t>(first - t_ns.begin()), static_cast<std::size_t>(last - t_ns.begin())};
}

// An empty column, of a sensor that is not there, stays empty.
template <class T>
std::vector<T> cut_column(const std::vector<T>& column, const Rows& rows) {
  if (column.empty()) return {};
  return {column.begin() + static_cast<std::ptrdiff_t>(rows.first),
          column.begin() + static_cast<std::ptrdiff_t>(rows.last)};
}

TrackerStream cut_poses(const TrackerStream& tracker, std::int64_t start_ns, std::int64_t end_ns) {
  const Rows poses = rows_between(tracker.t_ns, start_ns, end_ns);
  return {cut_column(tracker.t_ns, poses),
          cut_column(tracker.T_world_marker, poses),
          cut_column(tracker.markers, poses),
          cut_column(tracker.reprojection_px, poses),
          cut_column(tracker.sigma_position_m, poses),
          cut_column(tracker.sigma_rotation_rad, poses),
          cut_column(tracker.noise_position_m, poses),
          cut_column(tracker.noise_rotation_rad, poses)};
}

std::vector<Segment> join_near_segments(std::vector<Segment> segments) {
  std::stable_sort(segments.begin(), segments.end(),
                   [](const Segment& a, const Segment& b) { return a.start_ns < b.start_ns; });
  std::vector<Segment> out;
  std::int64_t longest_ns = 0;  // of those in the last
  for (const Segment& segment : segments) {
    const std::int64_t length_ns = segment.end_ns - segment.start_ns;
    if (out.empty() || segment.start_ns - out.back().end_ns >= kJoinedGap_ns) {
      out.push_back(segment);
      longest_ns = length_ns;
      continue;
    }
    Segment& last = out.back();
    last.end_ns = std::max(last.end_ns, segment.end_ns);
    if (length_ns > longest_ns) last.name = segment.name;
    longest_ns = std::max(longest_ns, length_ns);
  }
  return out;
}

std::string folder_name(const std::string& name) {
  constexpr std::size_t kLongest_bytes = 64;
  std::string out = name.substr(0, kLongest_bytes);
  for (char& c : out) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!letter && c != '-' && c != '_' && c != '.') c = '_';
  }
  return out.starts_with('.') ? "" : out;
}

}  // namespace

Recording cut_recording(const Recording& recording, std::int64_t start_ns, std::int64_t end_ns) {
  Recording out;
  out.info = recording.info;
  out.info.segments.clear();
  for (Segment segment : recording.info.segments) {
    segment.start_ns = std::max(segment.start_ns, start_ns);
    segment.end_ns = std::min(segment.end_ns, end_ns);
    if (segment.start_ns < segment.end_ns) out.info.segments.push_back(std::move(segment));
  }
  out.calibration = recording.calibration;
  out.problems = recording.problems;

  const ProbeStream& probe = recording.probe;
  const Rows samples = rows_between(probe.t_ns, start_ns, end_ns);
  out.probe = {cut_column(probe.t_ns, samples), cut_column(probe.accel_counts, samples),
               cut_column(probe.force_counts, samples), cut_column(probe.gyro_counts, samples),
               cut_column(probe.force3_counts, samples)};
  out.tracker = cut_poses(recording.tracker, start_ns, end_ns);
  for (const TrackerStream& poses : recording.body_poses) out.body_poses.push_back(cut_poses(poses, start_ns, end_ns));
  if (!recording.truth) return out;
  const Truth& truth = *recording.truth;
  const Rows known = rows_between(truth.t_ns, start_ns, end_ns);
  out.truth = {cut_column(truth.t_ns, known),           cut_column(truth.s_m, known),
               cut_column(truth.height_m, known),       cut_column(truth.p_world_tip_m, known),
               cut_column(truth.q_world_marker, known), cut_column(truth.force_N, known),
               cut_column(truth.T_world_object, known)};
  return out;
}

std::vector<Segment> separate_segments(const Recording& recording) {
  if (recording.info.recorder) return recording.info.segments;
  std::vector<Segment> out = join_near_segments(recording.info.segments);
  if (out.size() < 2) out.clear();
  return out;
}

Segment find_segment(const Recording& recording, const std::string& name) {
  const Segment* found = nullptr;
  std::string names;
  constexpr std::size_t kMostNames = 20;
  for (std::size_t i = 0; i < recording.info.segments.size(); ++i) {
    const Segment& segment = recording.info.segments[i];
    if (i < kMostNames) names += (names.empty() ? "" : ", ") + printable(segment.name);
    if (segment.name != name) continue;
    if (found != nullptr) throw Error("there is more than one segment '" + printable(name) + "'");
    found = &segment;
  }
  if (found == nullptr) {
    throw Error("the recording has no segment '" + printable(name) + "'" +
                (names.empty() ? "; it has no segments" : "; its segments: " + names));
  }
  return *found;
}

std::vector<std::string> segment_folders(const std::vector<Segment>& segments) {
  std::vector<std::string> out;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    std::string own = folder_name(segments[i].name);
    if (own.empty()) own = "segment";
    std::string name = own;
    // Bounded: each try has another number.
    for (std::size_t number = i + 1; !taken.insert(name).second; ++number) name = own + "_" + std::to_string(number);
    out.push_back(std::move(name));
  }
  return out;
}

}  // namespace asperity
