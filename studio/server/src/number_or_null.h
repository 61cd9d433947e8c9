#pragma once

#include <cmath>

#include "asperity/studio/block.h"

namespace asperity::studio {

// JSON has no nan and no infinity.
inline Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

}  // namespace asperity::studio
