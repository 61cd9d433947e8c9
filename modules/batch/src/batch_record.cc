#include "asperity/batch/batch_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/version.h"
#include "asperity/json/parse_json.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kFormat = "asperity-batch-scan";
constexpr std::uint64_t kLargestRecord_bytes = 16 << 20;

// FNV-1a of 64 bits (Fowler, Noll, Vo; RFC 9923).
class Fingerprint {
 public:
  void add(std::string_view text) {
    for (const char c : text) step(static_cast<unsigned char>(c));
    step(0);
  }
  std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  void step(unsigned char byte) {
    hash_ ^= byte;
    hash_ *= 0x100000001b3ULL;
  }
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

void add_file(const fs::path& file, const std::string& name, Fingerprint& out) {
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  const auto changed = fs::last_write_time(file, error);
  out.add(name);
  out.add(error ? "absent" : fmt::format("{} {}", bytes, changed.time_since_epoch().count()));
}

void add_input(const fs::path& path, const std::string& name, Fingerprint& out) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return add_file(path, name, out);
  std::vector<std::string> files;
  for (fs::recursive_directory_iterator i(path, error), end; !error && i != end; i.increment(error)) {
    std::error_code ignored;
    if (i->is_regular_file(ignored)) files.push_back(i->path().lexically_relative(path).string());
  }
  std::sort(files.begin(), files.end());
  out.add(name);
  for (const std::string& file : files) add_file(path / file, file, out);
}

StepRecord step_of(const Json& json) {
  return {json["step"].get<std::string>(), json["words"].get<std::vector<std::string>>(),
          json["inputs"].get<std::string>(), json["exit"].get<int>(), json["message"].get<std::string>()};
}

}  // namespace

std::string inputs_fingerprint(const fs::path& folder, const std::vector<std::string>& inputs) {
  Fingerprint out;
  for (const std::string& input : inputs) add_input(folder / input, input, out);
  return out.text();
}

bool is_up_to_date(const StepRecord& record, const BatchStep& step, const fs::path& folder,
                   const std::string& fingerprint) {
  std::error_code ignored;
  return record.is_done() && record.name == step.name && record.words == step.words && record.inputs == fingerprint &&
         fs::exists(folder / step.output, ignored);
}

std::string format_scan_record(const ScanRecord& record) {
  Json out;
  out["format"] = kFormat;
  out["version"] = 1;
  out["asperity"] = kVersion;
  out["name"] = record.name;
  out["recording"] = record.recording;
  out["steps"] = Json::array();
  for (const StepRecord& step : record.steps) {
    out["steps"].push_back({{"step", step.name},
                            {"words", Json(step.words)},
                            {"inputs", step.inputs},
                            {"exit", step.exit_code},
                            {"message", step.message}});
  }
  return out.dump_repaired(2) + "\n";
}

ScanRecord read_scan_record(const fs::path& file) {
  try {
    const Json json = parse_json(read_file(file, kLargestRecord_bytes), file.string());
    if (json["format"].text() != kFormat || json["version"].get<int>() != 1 || json["asperity"].text() != kVersion)
      return {};
    ScanRecord out{json["name"].get<std::string>(), json["recording"].get<std::string>(), {}};
    for (const Json& step : json["steps"]) out.steps.push_back(step_of(step));
    return out;
  } catch (const Error&) {
    return {};
  }
}

}  // namespace asperity
