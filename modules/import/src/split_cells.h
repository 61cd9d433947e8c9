#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// Takes a line apart at `separator` (' ': runs of blanks and tabs). The cells are without quotes and the blanks around
// them; a doubled quote within a quoted cell stays doubled. False if a quote is not closed.
bool split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells);

// The line without its end and the blanks around it begins with #, % or //.
bool is_comment_line(std::string_view line);

// What a cell says, as far as a number can be told from text.
enum class CellKind { kMissing, kNumber, kTime, kText };

// A cell's kind and, of a number, its value. `has_point` and `has_comma` are set where the cell has such a decimal
// mark.
struct ParsedCell {
  CellKind kind = CellKind::kText;
  double value = 0.0;
  bool has_point = false;
  bool has_comma = false;
};
ParsedCell parse_cell(std::string_view cell);

}  // namespace asperity
