#pragma once

#include "asperity/json/json.h"
#include "asperity/texture/named_values.h"

namespace asperity::app {

// An object with these keys, in their order.
Json json_of(const NamedValues& values);

}  // namespace asperity::app
