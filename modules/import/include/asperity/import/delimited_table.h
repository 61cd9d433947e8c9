#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/problem.h"

namespace asperity {

struct DelimitedColumn {
  std::string name;            // the lowest header row's cell without its unit; "" if there is none
  std::string unit;            // as the header states it; "" if it does not
  std::string group;           // the header cells above it, with blanks between
  std::vector<double> values;  // one a row; nan: blank, or text
  bool has_text = false;       // a cell is neither blank nor a number

  // Group and name.
  std::string label() const { return group.empty() ? name : name.empty() ? group : group + " " + name; }
};

// A table of delimited text with any separator, decimal mark and header.
struct DelimitedTable {
  std::string file;  // what messages call it
  std::uint64_t bytes = 0;
  std::uint32_t crc32 = 0;  // of the bytes as they are in the file
  std::string text;         // the whole file as UTF-8
  char separator = ',';
  bool decimal_comma = false;
  std::vector<std::string> preface;  // lines above the header: comments, keys with values
  std::vector<DelimitedColumn> columns;
  std::vector<std::size_t> row_begin;   // where each row begins in `text`
  std::vector<std::uint32_t> row_line;  // each row's line, from 1
  Problems problems;

  std::size_t rows() const { return row_begin.size(); }
  bool has_header() const;
  // A cell as it is in the file, without quotes and the blanks around it; "" where the row is shorter.
  std::string_view cell(std::size_t row, std::size_t column) const;
  // The cell behind `key` in the preface, letters of either case; "" if it is not there.
  std::string preface_value(std::string_view key) const;
  // "column #4 'Position X'".
  std::string describe(std::size_t column) const;
};

// True for what tables write where there is no value: blank, NaN, NA, N/A, null, - and the like.
bool is_missing_cell(std::string_view cell);

}  // namespace asperity
