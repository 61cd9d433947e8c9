#include "process/scan_sessions.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/recording/cut_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/studio/calls.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

// Changes with every file of a recording.
std::string stamp_of(const fs::path& recording) {
  std::string out;
  std::vector<std::string> names{"recording.json",   "probe.csv", "tracker.csv",
                                 "calibration.json", "truth.csv", "checksums.txt"};
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(recording, unreadable)) {
    if (const std::string name = entry.path().filename().string(); is_body_file(name)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    std::error_code error;
    const auto written = fs::last_write_time(recording / name, error);
    out += error ? "-" : std::to_string(written.time_since_epoch().count());
    const auto size = fs::file_size(recording / name, error);
    out += error ? " -\n" : " " + std::to_string(size) + "\n";
  }
  return out;
}

OpenScan read_scan(const fs::path& folder, const std::string& segment, const Observer& observer) {
  Recording recording = read_recording(folder, {}, observer);
  const std::vector<Segment> pieces = separate_segments(recording);
  std::vector<std::string> names = segment_folders(pieces);
  if (pieces.empty() && segment.empty()) return {ProcessSession(std::move(recording)), {}, ""};
  const auto found = segment.empty() ? names.begin() : std::find(names.begin(), names.end(), segment);
  if (found == names.end()) {
    throw Advice("the recording has no segment '" + printable(segment) + "'", "Choose one of its segments.");
  }
  const Segment& piece = pieces[static_cast<std::size_t>(found - names.begin())];
  std::string name = *found;
  return {ProcessSession(cut_recording(recording, piece.start_ns, piece.end_ns)), std::move(names), std::move(name)};
}

}  // namespace

OpenScan& ScanSessions::open(const fs::path& recording, const std::string& segment, const Observer& observer) {
  const std::string stamp = stamp_of(recording);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const KeptSession& kept) {
    return kept.recording == recording && kept.segment == segment;
  });
  if (found != kept_.end() && found->stamp == stamp) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().scan;
  }
  if (found != kept_.end()) kept_.erase(found);
  kept_.push_front({recording, segment, stamp, read_scan(recording, segment, observer)});
  if (kept_.size() > kMost) kept_.pop_back();
  return kept_.front().scan;
}

}  // namespace asperity::studio
