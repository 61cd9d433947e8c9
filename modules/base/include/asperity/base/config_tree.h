#pragma once

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "asperity/base/config.h"

namespace asperity {

// A setting as a value of a JSON library; what JSON has no number for (inf, nan) is text.
template <class Json>
Json config_leaf(const ConfigValue& value) {
  if (const auto* number = std::get_if<double>(&value); number != nullptr && !std::isfinite(*number)) {
    return Json(toml_text(value));
  }
  return std::visit([](const auto& each) { return Json(each); }, value);
}

// The settings as one object in their own order, an object a group.
template <class Json>
Json config_tree(const std::vector<ConfigField>& fields) {
  Json out = Json::object();
  for (const ConfigField& field : fields) {
    Json* place = &out;
    std::size_t start = 0;
    for (std::size_t dot = field.path.find('.'); dot != std::string::npos; dot = field.path.find('.', start)) {
      place = &(*place)[field.path.substr(start, dot - start)];
      start = dot + 1;
    }
    (*place)[field.path.substr(start)] = config_leaf<Json>(field.get());
  }
  return out;
}

}  // namespace asperity
