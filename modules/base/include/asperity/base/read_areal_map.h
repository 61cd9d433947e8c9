#pragma once

#include <array>

#include "asperity/base/areal_map.h"
#include "asperity/base/csv.h"

namespace asperity {

// Reads the rows of `table`, whose columns 0, 1, 2 are x, y, z in the units given (metres), into a map. They are a full
// rectangular grid, row by row with x or with y running fastest. Throws Error at the first point that is not where the
// grid of the rows before it puts it.
ArealMap read_areal_map(CsvReader& table, const std::array<double, 3>& unit_m);

}  // namespace asperity
