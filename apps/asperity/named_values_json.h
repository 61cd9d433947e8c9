#pragma once

#include <nlohmann/json.hpp>

#include "asperity/texture/named_values.h"

namespace asperity::app {

// An object with these keys, in their order.
nlohmann::ordered_json json_of(const NamedValues& values);

}  // namespace asperity::app
