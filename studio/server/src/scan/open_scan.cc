#include "scan/open_scan.h"

#include <system_error>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/read_recording.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr const char* kNote = ".asperity-scan.json";
constexpr std::uint64_t kLargestNote_bytes = 4096;

}  // namespace

void note_open_scan(const fs::path& folder, const std::string& recording) {
  Json note = Json::object();
  note["recording"] = recording;
  write_file(folder / kNote, note.dump_repaired() + '\n');
}

void forget_open_scan(const fs::path& folder) noexcept {
  std::error_code error;
  fs::remove(folder / kNote, error);
}

std::optional<RescuedScan> find_rescued_scan(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(folder / kNote, error))) return std::nullopt;
  RescuedScan out;
  try {
    const Json note = parse_json_or_null(read_file(folder / kNote, kLargestNote_bytes));
    if (!note.is_object() || !note.contains("recording") || !note["recording"].is_string()) return std::nullopt;
    out.recording = note["recording"].get<std::string>();
    const fs::path recorded = Project(folder).existing(out.recording);
    const Recording recording = read_recording(recorded);
    if (recording.probe.t_ns.empty()) return std::nullopt;
    out.duration_s = 1e-9 * static_cast<double>(recording.probe.t_ns.back() - recording.probe.t_ns.front());
  } catch (const Error& fault) {
    // A recording without a row that was stored is not there any more, or has nothing in it.
    if (out.recording.empty() || !fs::exists(folder / out.recording / "probe.csv", error)) return std::nullopt;
    out.problem = fault.what();
  }
  return out;
}

}  // namespace asperity::studio
