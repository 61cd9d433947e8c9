#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/import/column_map.h"
#include "asperity/import/delimited_table.h"

namespace asperity {

// "accX" → acc, x; "p_RS_R_x" → p, rs, r, x; "Rot[0]" → rot, 0.
std::vector<std::string> split_name_words(std::string_view name);

// What a column's name and the rows above it say.
struct ColumnWords {
  char kind = 0;  // the letter that meanings of this kind begin with: p, q, r, a, g, f; 0: an axis alone
  char axis = 0;  // x, y, z, w; 0: a force without axis
};
std::optional<ColumnWords> words_of_column(const DelimitedColumn& column);

// The unit at the end of a name, behind its last or last but one _ or blank: "px_mm", "gx_deg_s", "force N".
struct NameWithUnit {
  std::string name, unit;
};
std::optional<NameWithUnit> split_unit_of_name(const std::string& name);

// True if the header or the name states a unit that meanings of this kind cannot have.
bool has_other_unit(const DelimitedColumn& column, char kind);

// The kind that such a unit alone says: a length p, an angular rate g, an acceleration a, a force f. 0: none or several
// (g is a unit of both of the latter).
char kind_of_unit(const DelimitedColumn& column);

}  // namespace asperity
