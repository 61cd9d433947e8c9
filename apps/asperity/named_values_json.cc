#include "named_values_json.h"

#include <type_traits>
#include <variant>

namespace asperity::app {

Json json_of(const NamedValues& values) {
  auto out = Json::object();
  for (const NamedValue& one : values.all()) {
    std::visit(
        [&]<class T>(const T& value) {
          if constexpr (std::is_same_v<T, NamedValues>)
            out[one.name] = json_of(value);
          else
            out[one.name] = value;
        },
        one.value);
  }
  return out;
}

}  // namespace asperity::app
