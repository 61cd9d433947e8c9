#pragma once

#include <filesystem>

#include "asperity/calibration/fit_force_line.h"

namespace asperity {

// A table `counts,force_N`, one reading a line; other columns are passed over. Throws Error naming file, line and
// column for a value that is not a finite number, and for more than a million lines.
ForcePoints read_force_points(const std::filesystem::path& file);

}  // namespace asperity
