#include "completion_settings.h"

#include <map>
#include <utility>

namespace asperity::app {

std::string CaseSyntax::line(const std::string& pattern, const std::string& words) const {
  return "    " + pattern + ") " + std::string(variable) + "=" + std::string(open) + words + std::string(close) +
         " ;;\n";
}

std::vector<std::string> values_of(const ConfigField& field) {
  if (field.type == FieldType::kBool) return {"true", "false"};
  return field.choices;
}

std::string setting_keys(const CommandSettings& settings) {
  std::string out;
  for (const ConfigField& field : settings.fields) out += (out.empty() ? "" : " ") + field.path + "=";
  return out;
}

std::string setting_key_cases(const std::vector<CommandSettings>& all, const CaseSyntax& syntax) {
  std::map<std::string, std::string> patterns;  // by the keys: commands may have the same
  for (const CommandSettings& settings : all) {
    if (settings.fields.empty()) continue;
    std::string& pattern = patterns[setting_keys(settings)];
    pattern += (pattern.empty() ? "\"" : " | \"") + settings.command + " --set\"";
  }
  std::string out;
  for (const auto& [keys, pattern] : patterns) out += syntax.line(pattern, keys);
  return out;
}

std::string setting_value_cases(const std::vector<CommandSettings>& all, const CaseSyntax& syntax) {
  std::map<std::pair<std::string, std::string>, std::string> patterns;  // by key and values
  for (const CommandSettings& settings : all) {
    for (const ConfigField& field : settings.fields) {
      std::string values;
      for (const std::string& value : values_of(field)) values += (values.empty() ? "" : " ") + value;
      if (values.empty()) continue;
      std::string& pattern = patterns[{field.path, values}];
      pattern += (pattern.empty() ? "\"" : " | \"") + settings.command + " " + field.path + "\"";
    }
  }
  std::string out;
  for (const auto& [key, pattern] : patterns) out += syntax.line(pattern, key.second);
  return out;
}

}  // namespace asperity::app
