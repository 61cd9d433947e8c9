#pragma once

#include <array>

#include "asperity/profile/areal_map.h"
#include "number_table.h"

namespace asperity {

// Reads the rows of `table`, whose columns 0, 1, 2 are x, y, z in the units given (metres), into a
// map. Throws Error at the first point that is not where the grid of the rows before it puts it.
ArealMap read_areal_grid(NumberTable& table, const std::array<double, 3>& unit_m);

}  // namespace asperity
