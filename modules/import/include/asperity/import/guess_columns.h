#pragma once

#include <string>

#include "asperity/import/column_map.h"
#include "asperity/import/delimited_table.h"

namespace asperity {

// What a file is given for.
enum class FileRole { kPose, kImu, kGyro, kForce };

// Adds to `map` the columns of the groups that `role` needs and `map` has none of, by their names: an axis (x, y, z, w)
// behind a word (pos, quat, acc, gyro, force, …), "Rotation X" with a "Rotation W" beside it as a quaternion, bare x,
// y, z by the role and the file's name. Of several bodies the first, or the one whose name is `body`. Nothing is added
// where names leave it open. `file` is the file's name without its folder.
void guess_columns(const DelimitedTable& table, FileRole role, const std::string& file, const std::string& body,
                   ColumnMap& map);

// Gives a unit to each column that has none: by the end of its name ("px_mm"), else by its values: the rate that a time
// would give, the size of positions and angles, specific force nearest to 1 g. `unit_why` states which.
void guess_units(const DelimitedTable& table, ColumnMap& map);

}  // namespace asperity
