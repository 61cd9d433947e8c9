#include "asperity/recording/read_recording.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/in_background.h"
#include "asperity/base/inner_path.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/parse_recording.h"
#include "block_checksums.h"
#include "unfinished.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// Nothing outside the folder is read in the name of a recording.
fs::path own_file(const fs::path& folder, const std::string& name) {
  if (!inner_file(folder, name))
    throw Error((folder / name).string() +
                ": is a link out of the recording, which is not followed; copy the file here");
  return folder / name;
}

std::size_t line_at(std::string_view text, std::uint64_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(byte, text.size()));
  return static_cast<std::size_t>(std::count(text.begin(), end, '\n')) + 1;
}

void note_changes(const std::string& text, const fs::path& path, const std::vector<BlockChecksum>& blocks,
                  Problems& problems) {
  for (const ChangedBytes& change : find_changes(text, blocks)) {
    const std::size_t first = line_at(text, change.begin);
    if (change.begin == change.end) {
      problems.push_back(
          {"changed", fmt::format("{}:{}: rows that were recorded are missing here", path.string(), first)});
      continue;
    }
    const std::size_t last = line_at(text, change.end - 1);
    problems.push_back({"changed",
                        fmt::format("{}:{}: from here to line {} are not the bytes that were recorded ({})",
                                    path.string(), first, last, kChecksumFile),
                        last - first + 1});
  }
}

// A stream, held against its checksums where there are any.
template <class Parse>
auto read_stream(const fs::path& folder, const std::string& name, const ReadLimits& limits, Problems& problems,
                 const Parse& parse) {
  const fs::path path = own_file(folder, name);
  const std::string text = read_file(path, limits.csv_bytes);
  std::error_code error;
  const fs::path checksums = own_file(folder, kChecksumFile);
  const std::size_t before = problems.size();
  if (fs::exists(checksums, error))
    note_changes(text, path, parse_checksums(read_file(checksums, limits.json_bytes), name), problems);
  try {
    return parse(text, path.string(), problems, limits);
  } catch (const Error& fault) {
    if (problems.size() == before) throw;
    throw Error(std::string(fault.what()) +
                "; the file is not as it was recorded, and 'asperity recover' saves the rows that are");
  }
}

}  // namespace

Calibration read_calibration(const fs::path& path, const ReadLimits& limits, const Observer& observer) {
  return parse_calibration(read_file(path, limits.json_bytes), path.string(), limits, observer);
}

Truth read_truth(const fs::path& path, Problems& problems, const ReadLimits& limits) {
  return parse_truth_csv(read_file(path, limits.csv_bytes), path.string(), problems, limits);
}

namespace {

// recording.json and calibration.json: where they are not there, no table is read.
Recording read_head(const fs::path& folder, const ReadLimits& limits, const Observer& observer) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw Error(folder.string() + ": not a recording folder");
  const fs::path info = own_file(folder, "recording.json");
  if (!fs::exists(info, error)) throw Error(folder.string() + ": not a recording: recording.json is missing");
  Recording out;
  out.info = parse_recording_info(read_file(info, limits.json_bytes), info.string(), limits, observer);
  const fs::path calibration = own_file(folder, "calibration.json");
  if (!fs::exists(calibration, error)) {
    throw Error(folder.string() + ": calibration.json is missing; without it counts and poses have no units");
  }
  out.calibration = read_calibration(calibration, limits, observer);
  return out;
}

}  // namespace

Recording read_probe_recording(const fs::path& folder, const ReadLimits& limits, const Observer& observer) {
  Recording out = read_head(folder, limits, observer);
  observer.without_progress().update("read", 0.0);
  out.probe = read_stream(folder, "probe.csv", limits, out.problems, parse_probe_csv);
  return out;
}

Recording read_recording(const fs::path& folder, const ReadLimits& limits, const Observer& observer) {
  Recording out = read_head(folder, limits, observer);
  observer.without_progress().update("read", 0.0);
  // A simulated recording's truth is the larger part of it: read beside the rest.
  Problems problems_of_truth;
  auto truth = in_background([&]() -> std::optional<Truth> {
    const fs::path path = own_file(folder, "truth.csv");
    std::error_code error;
    if (!fs::exists(path, error)) return std::nullopt;
    return read_truth(path, problems_of_truth, limits);
  });
  out.probe = read_stream(folder, "probe.csv", limits, out.problems, parse_probe_csv);
  observer.without_progress().update("read", 0.0);
  out.tracker = read_stream(folder, "tracker.csv", limits, out.problems, parse_tracker_csv);
  for (const TrackedBody& body : out.info.bodies)
    out.body_poses.push_back(read_stream(folder, body_file(body.name), limits, out.problems, parse_body_csv));
  out.truth = truth.get();
  out.problems.insert(out.problems.end(), problems_of_truth.begin(), problems_of_truth.end());
  close_unfinished(out);
  return out;
}

bool is_recording_folder(const fs::path& folder) noexcept {
  try {
    constexpr std::uint64_t kLargest_bytes = std::uint64_t{64} << 20;
    const auto root = parse_json_or_null(read_file(folder / "recording.json", kLargest_bytes));
    return root.is_object() && root.value("format", "") == "asperity-recording";
  } catch (const std::exception&) {
    return false;
  }
}

bool is_replaceable_recording(const fs::path& folder) noexcept {
  constexpr std::array<std::string_view, 9> kOurs{"recording.json", "probe.csv",    "tracker.csv",
                                                  "truth.csv",      kChecksumFile,  "calibration.json",
                                                  "camera.json",    "markers.json", "frames"};
  try {
    constexpr std::uint64_t kLargest_bytes = std::uint64_t{64} << 20;
    const auto root = parse_json_or_null(read_file(folder / "recording.json", kLargest_bytes));
    if (!root.is_object() || root.value("format", "") != "asperity-recording" || !root.contains("extra")) return false;
    const auto& extra = root["extra"];
    if (!extra.is_object() || !(extra.contains("simulation") || extra.contains("imported"))) return false;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (std::find(kOurs.begin(), kOurs.end(), name) == kOurs.end() && !is_body_file(name)) return false;
    }
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace asperity
