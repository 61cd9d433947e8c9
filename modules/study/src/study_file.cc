#include "asperity/study/study_file.h"

#include <algorithm>
#include <limits>
#include <set>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/config_json.h"
#include "asperity/json/parse_json.h"
#include "asperity/study/study_error.h"

namespace asperity {

namespace {

constexpr std::size_t kLongestText = 500, kLongestConsent = 4000, kLongestName = 60, kLongestCode = 40,
                      kLongestFile = 300, kMostStimuli = 32;
constexpr std::uint64_t kLargestWhole = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t kDeepest = 4;

[[noreturn]] void refuse(const std::string& where, const std::string& key, const std::string& why) {
  throw Error(where + ": " + printable(key, 100) + ": " + why);
}

std::string text_of(const std::string& where, const std::string& key, const Json& value, std::size_t longest) {
  if (!value.is_string()) refuse(where, key, "text is needed");
  auto text = value.get<std::string>();
  if (text.size() > longest) refuse(where, key, "longer than " + std::to_string(longest) + " bytes");
  if (!is_utf8(text)) refuse(where, key, "not UTF-8");
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  if (std::any_of(text.begin(), text.end(), control)) refuse(where, key, "has a control character");
  return text;
}

bool is_plain(const std::string& text, std::size_t longest) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !text.empty() && text.size() <= longest && std::all_of(text.begin(), text.end(), plain);
}

void set_leaf(const std::vector<ConfigField>& fields, const std::string& where, const std::string& path,
              const Json& value) {
  ConfigValue leaf;
  if (value.is_string()) {
    leaf = text_of(where, path, value, kLongestText);
  } else if (value.is_boolean()) {
    leaf = value.get<bool>();
  } else if (value.is_number_integer() &&
             (!value.is_number_unsigned() || value.get<std::uint64_t>() <= kLargestWhole)) {
    leaf = value.get<std::int64_t>();
  } else if (value.is_number()) {
    leaf = value.get<double>();
  } else {
    refuse(where, path, "text, a number, or true or false is needed");
  }
  try {
    find_field(fields, path).set(leaf);
  } catch (const Error& fault) {
    throw Error(where + ": " + fault.what());
  }
}

std::vector<std::string> stimuli_of(const std::string& where, const Json& value) {
  if (!value.is_array()) refuse(where, "stimuli", "a list of files is needed");
  if (value.size() > kMostStimuli) refuse(where, "stimuli", "more than " + std::to_string(kMostStimuli));
  std::vector<std::string> out;
  for (const Json& each : value) {
    out.push_back(text_of(where, "stimuli", each, kLongestFile));
    if (out.back().find(',') != std::string::npos) {
      refuse(where, "stimuli", "'" + printable(out.back()) + "' has a comma, which the log cannot hold; rename it");
    }
    if (trim(out.back()) != out.back()) {
      refuse(where, "stimuli",
             "'" + printable(out.back()) + "' begins or ends with a blank, which the log cannot hold; rename it");
    }
    if (std::count(out.begin(), out.end(), out.back()) > 1) {
      refuse(where, "stimuli", "'" + printable(out.back()) + "' is given twice");
    }
  }
  return out;
}

void put_field(Json& out, const ConfigField& field) {
  const Json value = config_value_json(field.get());
  const std::size_t dot = field.path.find('.');
  if (dot == std::string::npos) {
    out[field.path] = value;
  } else {
    out[field.path.substr(0, dot)][field.path.substr(dot + 1)] = value;
  }
}

}  // namespace

Json study_json(const Study& study) {
  Study copy = study;
  Json out;
  out["name"] = study.name;
  out["question"] = study.question;
  out["stimuli"] = study.stimuli;
  out["object"] = study.object;
  out["consent"] = study.consent;
  for (const ConfigField& field : list_fields("", copy)) put_field(out, field);
  out["presentation"]["device"] = study.presentation.device;
  return out;
}

Study read_study(const Json& value, const std::string& where) {
  if (!value.is_object()) throw Error(where + ": an object is needed");
  Study out;
  const std::vector<ConfigField> fields = list_fields("", out);
  for (const auto& [key, each] : value.items()) {
    if (key == "name") {
      out.name = text_of(where, key, each, kLongestText);
      if (!is_plain(out.name, kLongestName)) {
        refuse(where, key, "'" + printable(out.name) + "' is not 1 to 60 letters, digits, _ and -");
      }
    } else if (key == "question") {
      out.question = text_of(where, key, each, kLongestText);
    } else if (key == "object") {
      out.object = text_of(where, key, each, kLongestText);
    } else if (key == "consent") {
      out.consent = text_of(where, key, each, kLongestConsent);
    } else if (key == "stimuli") {
      out.stimuli = stimuli_of(where, each);
    } else if (key == "staircase" || key == "presentation") {
      if (!each.is_object()) refuse(where, key, "an object is needed");
      for (const auto& [inner, leaf] : each.items()) {
        if (key == "presentation" && inner == "device") {
          out.presentation.device = text_of(where, "presentation.device", leaf, kLongestText);
        } else {
          set_leaf(fields, where, key + "." + inner, leaf);
        }
      }
    } else {
      set_leaf(fields, where, key, each);
    }
  }
  return out;
}

Json parse_study_text(std::string_view text, const std::string& where) {
  JsonLimits limits;
  limits.bytes = kLargestStudy_bytes;
  limits.depth = kDeepest;
  return parse_json(text, where, limits);
}

Study parse_study_file(std::string_view text, const std::string& name) {
  Json value = parse_study_text(text, name);
  if (!value.is_object() || value.value("format", Json()) != Json(kStudyFormat)) {
    throw StudyError(StudyFault::kForeignFile,
                     name + ": is not a study: its format is not '" + std::string(kStudyFormat) + "'");
  }
  if (value.value("version", Json()) != Json(kStudyVersion)) {
    throw StudyError(StudyFault::kUnknownVersion, name + ": has a version that this program does not know; it knows " +
                                                      std::to_string(kStudyVersion));
  }
  value.erase("format");
  value.erase("version");
  return read_study(value, name);
}

std::string format_study_file(const Study& study) {
  Json out;
  out["format"] = kStudyFormat;
  out["version"] = kStudyVersion;
  const Json content = study_json(study);
  for (const auto& [key, value] : content.items()) out[key] = value;
  return out.dump(2) + '\n';
}

void check_participant(const std::string& code) {
  if (!is_plain(code, kLongestCode)) {
    throw StudyError(StudyFault::kParticipant,
                     "the participant's code '" + printable(code) + "' is not 1 to 40 letters, digits, _ and -");
  }
}

}  // namespace asperity
