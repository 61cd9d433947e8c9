#include "config_fields.h"

#include <array>
#include <cmath>
#include <string_view>

#include "asperity/json/config_json.h"

namespace asperity::studio {

namespace {

constexpr std::array<std::string_view, 6> kTypeNames{"bool", "integer", "number", "text", "choice", "numbers"};

}  // namespace

Json fields_json(const std::vector<ConfigField>& fields, const std::vector<ConfigField>& defaults) {
  Json out = Json::array();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const ConfigField& field = fields[i];
    Json each;
    each["path"] = field.path;
    each["type"] = kTypeNames.at(static_cast<std::size_t>(field.type));
    each["value"] = config_value_json(field.get());
    each["default"] = config_value_json(defaults.at(i).get());
    each["description"] = field.description;
    if (std::isfinite(field.range.low)) each["low"] = field.range.low;
    if (std::isfinite(field.range.high)) each["high"] = field.range.high;
    if (!field.choices.empty()) each["choices"] = field.choices;
    out.push_back(std::move(each));
  }
  return out;
}

void use_present_names(Json& section, std::string_view key, const std::vector<ConfigField>& fields) {
  Json* const settings = section.find(key);
  if (settings == nullptr || !settings->is_object()) return;
  for (const ConfigField& field : fields) {
    for (const std::string& former : field.former) {
      const Json* const found = settings->find(former);
      if (found == nullptr) continue;
      const Json value = *found;
      settings->erase(former);
      if (!settings->contains(field.path)) (*settings)[field.path] = value;
    }
  }
}

}  // namespace asperity::studio
