#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "asperity/recording/calibration.h"

namespace asperity {

// A marker body that the tracker follows in addition to the probe's (recording.json, `bodies`).
struct TrackedBody {
  std::string name;
  std::vector<int> markers;  // their ids; empty: not stated
};

// The body on the object that is scanned: with it the scan is relative to the object, which may move.
inline constexpr std::string_view kObjectBody = "object";

inline constexpr std::size_t kMostBodies = 8;

// 1 to 32 lower-case letters, digits, `_` and `-`.
bool is_body_name(std::string_view name);

// The body's stream in a recording's folder, tracker_NAME.csv.
std::string body_file(std::string_view name);
// Whether a file's name is one of these.
bool is_body_file(std::string_view file);

// The markers of one body, those of the probe for the empty name.
std::vector<MarkerPlacement> markers_of_body(const std::vector<MarkerPlacement>& markers, std::string_view body);
// The names of the bodies that the markers are on, without the probe's, each once, in the order of their markers.
std::vector<std::string> bodies_of(const std::vector<MarkerPlacement>& markers);
// The same with the ids of their markers, as recording.json lists them.
std::vector<TrackedBody> tracked_bodies(const std::vector<MarkerPlacement>& markers);

}  // namespace asperity
