#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "asperity/base/config.h"

namespace asperity {

// Keys keep the order in which they were set.
using Json = nlohmann::ordered_json;

// JSON has no nan and no infinity.
inline Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json config_object(const std::vector<ConfigField>& fields);

}  // namespace asperity
