#include "asperity/recording/tracked_body.h"

#include <algorithm>
#include <iterator>

#include "asperity/recording/recording.h"

namespace asperity {

namespace {

constexpr std::string_view kPrefix = "tracker_", kSuffix = ".csv";

bool is_name_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-'; }

}  // namespace

bool is_body_name(std::string_view name) {
  constexpr std::size_t kLongest = 32;
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), is_name_letter);
}

std::string body_file(std::string_view name) { return std::string(kPrefix).append(name).append(kSuffix); }

bool is_body_file(std::string_view file) {
  if (!file.starts_with(kPrefix) || !file.ends_with(kSuffix) || file.size() <= kPrefix.size() + kSuffix.size())
    return false;
  return is_body_name(file.substr(kPrefix.size(), file.size() - kPrefix.size() - kSuffix.size()));
}

std::vector<MarkerPlacement> markers_of_body(const std::vector<MarkerPlacement>& markers, std::string_view body) {
  std::vector<MarkerPlacement> out;
  std::copy_if(markers.begin(), markers.end(), std::back_inserter(out),
               [&](const MarkerPlacement& marker) { return marker.body == body; });
  return out;
}

std::vector<std::string> bodies_of(const std::vector<MarkerPlacement>& markers) {
  std::vector<std::string> out;
  for (const TrackedBody& body : tracked_bodies(markers)) out.push_back(body.name);
  return out;
}

std::vector<TrackedBody> tracked_bodies(const std::vector<MarkerPlacement>& markers) {
  std::vector<TrackedBody> out;
  for (const MarkerPlacement& marker : markers) {
    if (marker.body.empty()) continue;
    auto found = std::find_if(out.begin(), out.end(), [&](const TrackedBody& b) { return b.name == marker.body; });
    if (found == out.end()) found = out.insert(out.end(), {marker.body, {}});
    found->markers.push_back(marker.id);
  }
  return out;
}

const TrackerStream* Recording::poses_of(std::string_view body) const {
  for (std::size_t i = 0; i < info.bodies.size() && i < body_poses.size(); ++i) {
    if (info.bodies[i].name == body) return &body_poses[i];
  }
  return nullptr;
}

}  // namespace asperity
