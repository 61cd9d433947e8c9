#pragma once

#include <string>
#include <vector>

#include "asperity/import/column_map.h"
#include "asperity/import/delimited_table.h"
#include "asperity/import/guess_columns.h"
#include "asperity/import/mapping_config.h"

namespace asperity {

// What is known of a file by whose it is.
struct FilePreset {
  std::string name;    // "" if it is no one's
  ColumnMap map;       // columns that names do not give, or not right
  std::string length;  // the unit of lengths that the file states apart from the columns
  std::string up;      // the world's axis that points up, as the program exports it; "" where that is the user's choice
  std::string euler;   // the order of its Euler angles
  double rate_Hz = 0.0;  // of its rows; 0: they have times
};

// The names that --preset takes.
std::vector<std::string> preset_names();

// The preset of this name, or, if it is empty, the one whose marks the table has (its preface, header, number of
// columns). Throws Error for an unknown name, and if the table does not have the marks of the preset that was asked
// for.
FilePreset find_preset(const DelimitedTable& table, FileRole role, const std::string& name);

// The table that comes with a role in a file of several (Vicon's): its first line; "" for most files.
std::string preset_section(const std::string& text, FileRole role);

}  // namespace asperity
