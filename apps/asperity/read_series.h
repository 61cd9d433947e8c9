#pragma once

#include <string>

#include "asperity/texture/texture_fit.h"

namespace asperity::app {

// A table t_s,acceleration_mps2,speed_mps,force_N (more columns allowed). Throws Error naming file, line and
// column for a number that is missing or not finite, or times that are not even to a hundredth of a step.
SeriesTable read_series(const std::string& file);

}  // namespace asperity::app
