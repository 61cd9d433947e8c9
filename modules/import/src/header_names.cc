#include "header_names.h"

#include <algorithm>

#include "asperity/base/text.h"
#include "asperity/import/import_unit.h"
#include "split_cells.h"

namespace asperity {

namespace {

using HeaderRow = std::vector<std::string>;

std::string without_doubled_quotes(std::string_view cell) {
  std::string out;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    out += cell[i];
    if (cell[i] == '"' && i + 1 < cell.size() && cell[i + 1] == '"') ++i;
  }
  return out;
}

// Between blanks a unit in brackets is a cell of its own: it belongs to the name before it.
void join_units(HeaderRow& row) {
  for (std::size_t i = 1; i < row.size();) {
    if (row[i].starts_with('[') || row[i].starts_with('(')) {
      row[i - 1] += " " + row[i];
      row.erase(row.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

bool is_unit_row(const HeaderRow& row) {
  std::size_t units = 0;
  for (const std::string& cell : row) {
    if (cell.empty()) continue;
    const NameAndUnit parts = split_name_and_unit(cell);
    const bool bracketed = parts.name.empty() && !parts.unit.empty();
    if (!bracketed && !is_unit(cell)) return false;
    ++units;
  }
  return units > 0;
}

void append_word(std::string& words, const std::string& word) {
  if (word.empty()) return;
  if (!words.empty()) words += ' ';
  words += word;
}

}  // namespace

NameAndUnit split_name_and_unit(std::string_view cell) {
  const std::string_view all = trim(cell);
  for (const auto& [open, close] : {std::pair('[', ']'), std::pair('(', ')')}) {
    const auto begin = all.rfind(open);
    if (begin == std::string_view::npos || all.back() != close) continue;
    return {std::string(trim(all.substr(0, begin))), std::string(trim(all.substr(begin + 1, all.size() - begin - 2)))};
  }
  const auto slash = all.find('/');
  if (slash != std::string_view::npos && slash > 0 && is_unit(all.substr(slash + 1))) {
    return {std::string(trim(all.substr(0, slash))), std::string(trim(all.substr(slash + 1)))};
  }
  return {std::string(all), {}};
}

void name_columns(std::string_view text, const DelimitedLayout& layout, std::vector<DelimitedColumn>& columns) {
  std::vector<HeaderRow> rows;
  std::vector<std::string_view> cells;
  for (const TextLine& line : layout.header) {
    split_cells(text.substr(line.begin, line.end - line.begin), layout.separator, cells);
    HeaderRow row;
    for (const std::string_view cell : cells) row.push_back(without_doubled_quotes(cell));
    if (layout.separator == ' ') join_units(row);
    row.resize(columns.size());
    rows.push_back(std::move(row));
  }
  if (!rows.empty() && is_unit_row(rows.back()) && rows.size() > 1) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const NameAndUnit parts = split_name_and_unit(rows.back()[i]);
      columns[i].unit = parts.name.empty() ? parts.unit : rows.back()[i];
    }
    rows.pop_back();
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    HeaderRow& row = rows[r];
    const bool lowest = r + 1 == rows.size();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (lowest) {
        const NameAndUnit parts = split_name_and_unit(row[i]);
        columns[i].name = parts.name;
        if (columns[i].unit.empty()) columns[i].unit = parts.unit;
      } else {
        // A name that ends in a colon is the row's, not the columns'.
        if (i > 0 && row[i].empty() && !row[i - 1].ends_with(':')) row[i] = row[i - 1];
        append_word(columns[i].group, row[i]);
      }
    }
  }
}

}  // namespace asperity
