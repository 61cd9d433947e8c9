#include "asperity/recording/recording_source.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/read_recording.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// Of extra.import_origin.
std::vector<std::string> files_of_import(const Json& extra) {
  std::vector<std::string> out;
  const Json* origin = extra.is_object() ? extra.find("import_origin") : nullptr;
  const Json* files = origin != nullptr && origin->is_object() ? origin->find("files") : nullptr;
  if (files == nullptr || !files->is_array()) return out;
  for (const Json& file : *files) {
    if (!file.is_object()) continue;
    const std::string name = file.value("file", "") + " " + file.value("crc32", "");
    if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
  }
  return out;
}

// nullopt: the folder holds no recording of ours.
std::optional<RecordingSource> source_in(const fs::path& folder) {
  try {
    constexpr std::uint64_t kLargest_bytes = std::uint64_t{64} << 20;
    const auto root = parse_json_or_null(read_file(folder / "recording.json", kLargest_bytes));
    if (!root.is_object() || root.value("format", "") != "asperity-recording") return std::nullopt;
    const Json* extra = root.find("extra");
    if (extra == nullptr || !extra->is_object()) return RecordingSource{};
    if (extra->contains("simulation")) return RecordingSource{RecordingKind::kSimulated, {}};
    if (extra->contains("imported")) return RecordingSource{RecordingKind::kImported, files_of_import(*extra)};
    return RecordingSource{};
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::string names_of(const std::vector<std::string>& files) {
  std::string out;
  for (const std::string& file : files)
    out += (out.empty() ? "" : ", ") + printable(file.substr(0, file.rfind(' ')), 80);
  return out.empty() ? "files that it does not name" : out;
}

std::string content_text(const RecordingSource& source) {
  if (source.kind == RecordingKind::kSimulated) return "a simulated recording";
  if (source.kind == RecordingKind::kMeasured) return "a measured recording";
  return "a recording that was imported from " + names_of(source.files);
}

bool may_replace(const RecordingSource& by, const RecordingSource& old) {
  if (by.kind != old.kind || by.kind == RecordingKind::kMeasured) return false;
  if (by.kind == RecordingKind::kSimulated) return true;
  return !old.files.empty() && std::all_of(old.files.begin(), old.files.end(), [&](const std::string& file) {
    return std::find(by.files.begin(), by.files.end(), file) != by.files.end();
  });
}

}  // namespace

RecordingSource source_of(const Recording& recording) {
  if (recording.info.simulation) return {RecordingKind::kSimulated, {}};
  if (recording.info.imported) return {RecordingKind::kImported, files_of_import(recording.info.extra)};
  return {};
}

std::function<bool(const fs::path&)> replaceable_by(RecordingSource source) {
  return [source = std::move(source)](const fs::path& folder) {
    const auto old = source_in(folder);
    if (!old) return false;
    if (!may_replace(source, *old)) {
      throw Error(printable(folder.string(), 200) + ": holds " + content_text(*old) + ", which is replaced only by " +
                  (old->kind == RecordingKind::kSimulated  ? "another simulation"
                   : old->kind == RecordingKind::kImported ? "an import of the same files, unchanged"
                                                           : "nothing") +
                  "; nothing was changed. Choose another output folder, or move this one elsewhere");
    }
    return is_replaceable_recording(folder);
  };
}

}  // namespace asperity
