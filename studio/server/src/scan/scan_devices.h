#pragma once

#include "asperity/json/json.h"

namespace asperity::studio {

// Serial ports and cameras that are there, by name alone, as `scan.sources` answers; none is opened.
Json devices_json();

}  // namespace asperity::studio
