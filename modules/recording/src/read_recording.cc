#include "asperity/recording/read_recording.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/parse_recording.h"
#include "unfinished.h"

namespace asperity {

namespace fs = std::filesystem;

Calibration read_calibration(const fs::path& path, const ReadLimits& limits, const Observer& observer) {
  return parse_calibration(read_file(path, limits.json_bytes), path.string(), limits, observer);
}

Truth read_truth(const fs::path& path, Problems& problems, const ReadLimits& limits) {
  return parse_truth_csv(read_file(path, limits.csv_bytes), path.string(), problems, limits);
}

Recording read_probe_recording(const fs::path& folder, const ReadLimits& limits, const Observer& observer) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw Error(folder.string() + ": not a recording folder");
  const fs::path info = folder / "recording.json";
  if (!fs::exists(info, error)) throw Error(folder.string() + ": not a recording: recording.json is missing");
  Recording out;
  out.info = parse_recording_info(read_file(info, limits.json_bytes), info.string(), limits, observer);
  const fs::path calibration = folder / "calibration.json";
  if (!fs::exists(calibration, error)) {
    throw Error(folder.string() + ": calibration.json is missing; counts and poses mean nothing without it");
  }
  out.calibration = read_calibration(calibration, limits, observer);
  observer.without_progress().update("read", 0.0);
  const fs::path probe = folder / "probe.csv";
  out.probe = parse_probe_csv(read_file(probe, limits.csv_bytes), probe.string(), out.problems, limits);
  return out;
}

Recording read_recording(const fs::path& folder, const ReadLimits& limits, const Observer& observer) {
  Recording out = read_probe_recording(folder, limits, observer);
  observer.without_progress().update("read", 0.0);
  const fs::path tracker = folder / "tracker.csv";
  out.tracker = parse_tracker_csv(read_file(tracker, limits.csv_bytes), tracker.string(), out.problems, limits);
  const fs::path truth = folder / "truth.csv";
  std::error_code error;
  if (fs::exists(truth, error)) out.truth = read_truth(truth, out.problems, limits);
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
  constexpr std::array<std::string_view, 8> kOurs{"recording.json",   "probe.csv",   "tracker.csv",  "truth.csv",
                                                  "calibration.json", "camera.json", "markers.json", "frames"};
  try {
    constexpr std::uint64_t kLargest_bytes = std::uint64_t{64} << 20;
    const auto root = parse_json_or_null(read_file(folder / "recording.json", kLargest_bytes));
    if (!root.is_object() || root.value("format", "") != "asperity-recording" || !root.contains("extra")) return false;
    const auto& extra = root["extra"];
    if (!extra.is_object() || !(extra.contains("simulation") || extra.contains("imported"))) return false;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (std::find(kOurs.begin(), kOurs.end(), entry.path().filename().string()) == kOurs.end()) return false;
    }
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace asperity
