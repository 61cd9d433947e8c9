#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// Comma-separated numbers, with a header line or without one. Blank lines and lines that begin with #
// are passed over.
class NumberTable {
 public:
  // Takes the first line as header unless all its cells are numbers. Throws Error if there is none.
  NumberTable(std::string_view text, std::string name);

  const std::vector<std::string>& header() const { return header_; }  // empty if there was none
  std::size_t width() const { return width_; }
  std::optional<std::size_t> find(std::string_view column) const;

  // Goes to the next row; false at the end. Throws Error for a row with another number of cells.
  bool next();
  // The cell's number in the unit given by `scale`; nan is allowed, infinity and text throw Error.
  double number(std::size_t column, double scale) const;

  bool ends_in_newline() const { return ends_in_newline_; }
  [[noreturn]] void fail(const std::string& message) const;  // at the current line
  std::string column_name(std::size_t column) const;

 private:
  bool next_line();

  std::string name_;
  std::string_view rest_;
  std::string_view row_;  // a row without header that was read to tell
  std::vector<std::string> header_;
  std::vector<std::string_view> cells_;
  std::size_t width_ = 0;
  std::size_t line_ = 0;
  bool first_row_pending_ = false;
  bool ends_in_newline_ = false;
};

// The unit that a column's name ends in (_nm, _um, _µm, _mm, _m), as metres; nullopt if it has none.
std::optional<double> unit_in_name_m(std::string_view column);

}  // namespace asperity
