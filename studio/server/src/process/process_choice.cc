#include "process/process_choice.h"

#include "asperity/base/error.h"
#include "asperity/studio/calls.h"
#include "json_keys.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kLongestText = 1024;

const Json& member(const Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name)) throw Error(std::string("process: '") + name + "' is missing");
  return object.at(name);
}

std::string text_of(const Json& value, const std::string& name) {
  if (!value.is_string()) throw Error("process: '" + name + "' is not text");
  std::string text = value.get<std::string>();
  if (text.size() > kLongestText) throw Error("process: '" + name + "' is too long");
  return text;
}

void read_settings(const Json& config, const std::vector<ConfigField>& fields) {
  if (!config.is_object()) throw Error("process: 'config' is not an object of settings");
  for (const auto& [path, value] : config.items()) set_field(fields, path, text_of(value, path));
}

MergeChoice merge_choice(const Json& json) {
  MergeChoice out;
  if (!json.is_object()) throw Error("process: 'merge' is not an object");
  refuse_unknown(json, {"strokes", "config"}, "process");
  const Json& strokes = member(json, "strokes");
  if (!strokes.is_array() || strokes.size() > kMostScans) {
    throw Advice("at most " + std::to_string(kMostScans) + " strokes can be merged",
                 "Remove one before you add another.");
  }
  for (const Json& stroke : strokes) out.strokes.push_back(text_of(stroke, "strokes"));
  read_settings(member(json, "config"), list_fields("align", out.align));
  return out;
}

}  // namespace

Json first_process_section() {
  return {{"scans", Json::array()}, {"current", 0}, {"config", Json::object()}, {"merge", first_merge()}};
}

Json first_merge() { return {{"strokes", Json::array()}, {"config", Json::object()}}; }

ScanName scan_name(const Json& json) {
  ScanName out;
  if (json.is_object()) refuse_unknown(json, {"recording", "segment"}, "process");
  out.recording = text_of(member(json, "recording"), "recording");
  if (json.contains("segment")) out.segment = text_of(json.at("segment"), "segment");
  return out;
}

ProcessChoice process_choice(const Json& section) {
  ProcessChoice out;
  refuse_unknown(section, {"scans", "current", "config", "merge"}, "process");
  const Json& scans = member(section, "scans");
  if (!scans.is_array() || scans.size() > kMostScans) {
    throw Advice("at most " + std::to_string(kMostScans) + " recordings can be shown together",
                 "Remove one before you add another.");
  }
  for (const Json& scan : scans) out.scans.push_back(scan_name(scan));
  const Json& current = member(section, "current");
  if (!current.is_number_unsigned() && !(current.is_number_integer() && current.get<std::int64_t>() >= 0)) {
    throw Error("process: 'current' is not an index");
  }
  out.current = std::min<std::size_t>(current.get<std::size_t>(), kMostScans);
  read_settings(member(section, "config"), list_fields("", out.config));
  if (section.contains("merge")) out.merge = merge_choice(section.at("merge"));
  return out;
}

}  // namespace asperity::studio
