#pragma once

#include <array>
#include <optional>
#include <vector>

#include "asperity/base/areal_map.h"

namespace asperity {

// The map whose points these are (x, y, z in metres), in any order; points of the grid that are not among them are nan.
// nullopt where no even grid holds them (to a tenth of a step), two are at one point of it, it has fewer than 2 by 2
// points, three quarters of its points would be missing, or the missing ones are the end of the last row or column
// alone, as in a file that was cut off.
std::optional<ArealMap> arrange_on_grid(const std::vector<std::array<double, 3>>& points_m);

}  // namespace asperity
