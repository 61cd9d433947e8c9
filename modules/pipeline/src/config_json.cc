#include "asperity/pipeline/config_json.h"

#include "asperity/json/parse_json.h"
#include "json.h"

namespace asperity {

Json config_object(const std::vector<ConfigField>& fields) {
  Json out = Json::object();
  for (const ConfigField& field : fields) {
    Json* place = &out;
    std::size_t start = 0;
    for (std::size_t dot = field.path.find('.'); dot != std::string::npos; dot = field.path.find('.', start)) {
      place = &(*place)[field.path.substr(start, dot - start)];
      start = dot + 1;
    }
    // TOML and JSON write booleans, numbers, lists and simple strings alike; what they do not share
    // (inf, nan) stays text.
    const std::string text = field.get();
    Json value = parse_json_or_null(text);
    (*place)[field.path.substr(start)] = value.is_null() ? Json(text) : std::move(value);
  }
  return out;
}

std::string config_json(const std::vector<ConfigField>& fields) { return config_object(fields).dump(2); }

}  // namespace asperity
