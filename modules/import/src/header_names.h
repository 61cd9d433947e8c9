#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "asperity/import/delimited_table.h"
#include "delimited_layout.h"

namespace asperity {

// A header cell taken apart: "X [mm]", "acc_x (g)", "F/N" are a name and a unit.
struct NameAndUnit {
  std::string name;
  std::string unit;
};
NameAndUnit split_name_and_unit(std::string_view cell);

// Names, units and groups of the columns from the header rows of `text`. Cells above the names reach to the next cell
// that is not blank.
void name_columns(std::string_view text, const DelimitedLayout& layout, std::vector<DelimitedColumn>& columns);

}  // namespace asperity
