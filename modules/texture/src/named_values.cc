#include "asperity/texture/named_values.h"

#include <utility>

namespace asperity {

const NamedValues::Value* NamedValues::find(std::string_view name) const {
  for (const NamedValue& value : values_) {
    if (value.name == name) return &value.value;
  }
  return nullptr;
}

void NamedValues::append(std::string_view name, Value value) {
  values_.push_back({std::string(name), std::move(value)});
}

}  // namespace asperity
