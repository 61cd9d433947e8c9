#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/import/delimited_table.h"
#include "asperity/import/import_unit.h"

namespace asperity {

// What a table's columns are read as, by the letters that --columns uses.
enum class ColumnGroup { kTime, kPosition, kRotation, kAcceleration, kRate, kForce };

// One column and what it means: t (time), t2 (added to it); px py pz; the rotation as a quaternion qw qx qy qz, Euler
// angles about the axes rx ry rz, a rotation vector vx vy vz or a matrix m11 … m33 (row, column); ax ay az (specific
// force); gx gy gz (angular rate); fx fy fz or f (force).
struct MappedColumn {
  std::string meaning;
  std::size_t column = 0;  // of the table, from 0
  std::string unit;        // by its name in import_unit.h
  bool negative = false;   // the value's sign is changed
  std::string why;         // "stated", "preset motive", "its name"
  std::string unit_why;    // "stated", "header", "preset motive", "assumed", …

  bool operator==(const MappedColumn&) const = default;
};
using ColumnMap = std::vector<MappedColumn>;

// The group and the quantity of a meaning. Throws Error for an unknown one, naming those that are known.
ColumnGroup group_of(std::string_view meaning);
Quantity quantity_of(std::string_view meaning);

// The column that means this; nullptr: none.
const MappedColumn* find_meaning(const ColumnMap& map, std::string_view meaning);
// Any column of the group is in it.
bool has_group(const ColumnMap& map, ColumnGroup group);

// One entry of --columns.
struct StatedColumn {
  std::string meaning;
  std::string column;  // a name, or #4
  std::string unit;    // "" if none is stated
  bool negative = false;
};

// "t=Timestamp[ms], px=-X[mm], qw='Rotation, W', ax=#7[1/16384 g], p=#2-#4[mm], q=#5-#8": names may be quoted; a range
// stands for px py pz, qx qy qz qw in `quaternion_order`, rx ry rz, vx vy vz, m11 … m33 (row by row), ax …, gx …, fx ….
// Throws Error naming `what` and the entry.
std::vector<StatedColumn> parse_columns(std::string_view text, std::string_view quaternion_order,
                                        std::string_view what);

// Where in the table an entry's column is, with its unit from the entry or from the header ("" if neither states one).
// A name matches a column's name, its label (group and name) or the end of its label. Throws Error naming the file, the
// entry and the columns that there are, or those that it could be.
MappedColumn find_stated_column(const StatedColumn& stated, const DelimitedTable& table);

// The map as --columns takes it, with numbers of columns where names would be ambiguous.
std::string columns_text(const ColumnMap& map, const DelimitedTable& table);

// Columns by number and name for messages, "#1 'clock', #3 'X'": these, by their numbers from 0, or all. Beyond 24 they
// are counted.
std::string column_list(const DelimitedTable& table, const std::vector<std::size_t>& columns);
std::string column_list(const DelimitedTable& table);

}  // namespace asperity
