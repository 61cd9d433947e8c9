#include "number_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

NumberTable::NumberTable(std::string_view text, std::string name)
    : name_(std::move(name)), rest_(text), ends_in_newline_(text.ends_with('\n')) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  if (!next_line()) throw Error(name_ + ":1: the file is empty");
  width_ = cells_.size();
  if (std::all_of(cells_.begin(), cells_.end(), [](std::string_view cell) { return parse_double(cell).has_value(); })) {
    first_row_pending_ = true;
    return;
  }
  for (const auto cell : cells_) {
    if (!is_utf8(cell)) fail("the header is not UTF-8 text: " + printable(cell));
    if (cell.empty()) fail("column " + std::to_string(header_.size() + 1) + " has no name");
    if (find(cell)) fail("column '" + printable(cell) + "' appears twice");
    header_.emplace_back(cell);
  }
}

std::optional<std::size_t> NumberTable::find(std::string_view column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header_.begin());
}

bool NumberTable::next_line() {
  while (!rest_.empty()) {
    const auto end = rest_.find('\n');
    row_ = trim(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    if (row_.empty() || row_.starts_with('#')) continue;
    cells_.clear();
    std::size_t start = 0;
    while (true) {
      const auto comma = row_.find(',', start);
      if (cells_.size() == 1000) fail("more than 1000 columns");
      cells_.push_back(trim(row_.substr(start, comma - start)));
      if (comma == std::string_view::npos) return true;
      start = comma + 1;
    }
  }
  return false;
}

bool NumberTable::next() {
  if (first_row_pending_) {
    first_row_pending_ = false;
    return true;
  }
  if (!next_line()) return false;
  if (cells_.size() != width_) {
    fail(std::to_string(cells_.size()) + (cells_.size() == 1 ? " cell" : " cells") + " where the first line has " +
         std::to_string(width_));
  }
  return true;
}

double NumberTable::number(std::size_t column, double scale) const {
  const auto value = parse_double(cells_[column]);
  if (!value) fail(column_name(column) + ": '" + printable(cells_[column]) + "' is not a number");
  if (std::isinf(*value)) fail(column_name(column) + ": '" + printable(cells_[column]) + "' is infinite");
  return *value * scale;
}

std::string NumberTable::column_name(std::size_t column) const {
  return header_.empty() ? "column " + std::to_string(column + 1) : "column '" + printable(header_[column]) + "'";
}

void NumberTable::fail(const std::string& message) const {
  throw Error(name_ + ":" + std::to_string(line_) + ": " + message);
}

std::optional<double> unit_in_name_m(std::string_view column) {
  // "µ" is either the micro sign or the Greek letter.
  constexpr std::array<std::pair<std::string_view, double>, 6> kUnits{
      {{"_nm", 1e-9}, {"_um", 1e-6}, {"_\xC2\xB5m", 1e-6}, {"_\xCE\xBCm", 1e-6}, {"_mm", 1e-3}, {"_m", 1.0}}};
  for (const auto& [suffix, metres] : kUnits) {
    if (column.ends_with(suffix)) return metres;
  }
  return std::nullopt;
}

}  // namespace asperity
