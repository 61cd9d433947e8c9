#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "asperity/import/column_map.h"
#include "asperity/import/delimited_table.h"

namespace asperity {

// What a file is given for.
enum class FileRole { kPose, kImu, kGyro, kForce };

// What is known of a table besides its text.
struct GuessContext {
  std::vector<std::size_t> taken{};  // columns that are stated or used for something else
  bool is_given = true;              // the file was given for this role: axes without a word are the role's
  bool all_axes = true;  // a quantity has three columns or none; false: positions and accelerations have fewer
};

// Adds to `map` the columns of the groups that `role` needs and `map` has none of, by their names: an axis (x, y, z, w)
// behind a word (pos, quat, acc, gyro, force, …), "Rotation X" with a "Rotation W" beside it as a quaternion; bare x,
// y, z by their unit, else by the role and the file's name; a force by its name alone ("force_N", "load"), or its z
// axis alone. Of several bodies the first, or the one whose name is `body`. A column that is in `map`, is taken or has
// the unit of another quantity is left out. Nothing is added where names leave it open. `file` is the file's name
// without its folder.
void guess_columns(const DelimitedTable& table, FileRole role, const std::string& file, const std::string& body,
                   ColumnMap& map, const GuessContext& context = {});

// Gives a unit to each column that has none: by the end of its name ("px_mm"), else by its values: the rate that a time
// would give, the size of positions and angles, specific force nearest to 1 g. `unit_why` states which.
void guess_units(const DelimitedTable& table, ColumnMap& map);

}  // namespace asperity
