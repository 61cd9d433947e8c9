#include "asperity/json/config_json.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <variant>

namespace asperity {

Json config_value_json(const ConfigValue& value) {
  const auto* number = std::get_if<double>(&value);
  if (number != nullptr && !std::isfinite(*number)) return toml_text(value);
  return std::visit([](const auto& each) { return Json(each); }, value);
}

Json config_json(const std::vector<ConfigField>& fields) {
  Json out = Json::object();
  for (const ConfigField& field : fields) {
    Json* group = &out;
    std::size_t start = 0;
    for (std::size_t dot = field.path.find('.'); dot != std::string::npos; dot = field.path.find('.', start)) {
      group = &(*group)[field.path.substr(start, dot - start)];
      start = dot + 1;
    }
    (*group)[field.path.substr(start)] = config_value_json(field.get());
  }
  return out;
}

}  // namespace asperity
