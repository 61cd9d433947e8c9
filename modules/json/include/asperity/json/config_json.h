#pragma once

#include <vector>

#include "asperity/base/config.h"
#include "asperity/json/json.h"

namespace asperity {

// A setting's value; what JSON has no number for (inf, nan) is text.
Json config_value_json(const ConfigValue& value);

// The settings as one object in their own order, an object a group.
Json config_json(const std::vector<ConfigField>& fields);

}  // namespace asperity
