#pragma once

#include <string>
#include <vector>

#include "asperity/base/config.h"

namespace asperity {

// The settings as one JSON object in their own order, an object a group; indented by two blanks.
std::string config_json(const std::vector<ConfigField>& fields);

}  // namespace asperity
