#include "asperity/base/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "open_file.h"

namespace asperity {

std::string read_file(const std::filesystem::path& path, std::uint64_t limit_bytes) {
  OpenFile file = open_file(path, limit_bytes);
  std::string text(file.bytes, '\0');
  file.stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  check_read(file.stream, path);
  text.resize(static_cast<std::size_t>(file.stream.gcount()));
  return text;
}

CsvReader::CsvReader(std::string_view text, std::string name, CsvHeader header) : name_(std::move(name)), rest_(text) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  std::string_view first;
  accept_unterminated_ = true;
  const bool found = next_line(first);
  accept_unterminated_ = false;
  const bool optional = header == CsvHeader::kOptional;
  if (!found) throw Error(name_ + (optional ? ":1: the file is empty" : ":1: the header line is missing"));
  for (std::size_t start = 0; start != std::string_view::npos;) {
    const auto comma = first.find(',', start);
    if (cells_.size() == 1000) fail("more than 1000 columns");
    cells_.push_back(trim(first.substr(start, comma - start)));
    start = comma == std::string_view::npos ? comma : comma + 1;
  }
  const auto is_number = [](std::string_view cell) { return parse_double(cell).has_value(); };
  first_row_pending_ = optional && std::all_of(cells_.begin(), cells_.end(), is_number);
  if (!first_row_pending_) take_header();
}

void CsvReader::take_header() {
  for (const std::string_view cell : cells_) {
    if (!is_utf8(cell)) fail("the header is not UTF-8 text: " + printable(cell));
    if (cell.empty()) fail("column " + std::to_string(columns_.size() + 1) + " has no name");
    if (find(cell)) fail("column '" + printable(cell) + "' appears twice");
    columns_.emplace_back(cell);
  }
}

std::optional<std::size_t> CsvReader::find(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvReader::require(std::string_view column) const {
  const auto found = find(column);
  if (!found) throw Error(name_ + ":1: column '" + std::string(column) + "' is missing");
  return *found;
}

namespace {

// Counts are whole numbers of a few digits, and most of what is read.
bool parse_short_integer(std::string_view text, double& value) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  constexpr std::size_t kExactDigits = 15;  // below 2^53
  if (text.empty() || text.size() > kExactDigits) return false;
  std::int64_t whole = 0;
  for (const char digit : text) {
    if (digit < '0' || digit > '9') return false;
    whole = 10 * whole + (digit - '0');
  }
  value = negative ? -static_cast<double>(whole) : static_cast<double>(whole);
  return true;
}

}  // namespace

bool CsvReader::next_line(std::string_view& line) {
  while (!rest_.empty()) {
    const auto end = rest_.find('\n');
    if (end == std::string_view::npos && !accept_unterminated_) {
      truncated_ = true;
      rest_ = {};
      return false;
    }
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::string_view content = trim(line);
    if (!content.empty() && content.front() != '#') return true;
  }
  return false;
}

bool CsvReader::next() {
  if (first_row_pending_) {
    first_row_pending_ = false;
    return true;
  }
  std::string_view line;
  if (!next_line(line)) return false;
  std::size_t count = 0;
  std::size_t start = 0;
  while (true) {
    const auto comma = line.find(',', start);
    if (count < cells_.size()) {
      const std::string_view cell = line.substr(start, comma - start);
      const bool blank_end = !cell.empty() && (cell.front() <= ' ' || cell.back() <= ' ');
      cells_[count] = blank_end ? trim(cell) : cell;
    }
    ++count;
    if (comma == std::string_view::npos) break;
    start = comma + 1;
  }
  if (count != cells_.size()) {
    fail(std::to_string(count) + (count == 1 ? " cell" : " cells") + " where the " +
         (columns_.empty() ? "first line" : "header") + " has " + std::to_string(cells_.size()));
  }
  return true;
}

double CsvReader::number(std::size_t column) const {
  const std::string_view cell = cells_[column];
  double plain = 0.0;
  if (parse_short_integer(cell, plain)) return plain;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), plain);
  if (error == std::errc{} && end == cell.data() + cell.size()) return plain;
  const auto value = parse_double(cell);  // with a sign or blanks before it
  if (!value) fail(column, "'" + printable(cells_[column]) + "' is not a number");
  return *value;
}

double CsvReader::finite(std::size_t column) const {
  const double value = number(column);
  if (!std::isfinite(value)) fail(column, "'" + printable(cells_[column]) + "' is not finite");
  return value;
}

double CsvReader::finite_or_nan(std::size_t column) const {
  const double value = number(column);
  if (std::isinf(value)) fail(column, "'" + printable(cells_[column]) + "' is infinite");
  return value;
}

std::int64_t CsvReader::integer(std::size_t column) const {
  const auto value = parse_int64(cells_[column]);
  if (!value) fail(column, "'" + printable(cells_[column]) + "' is not a whole number");
  return *value;
}

void CsvReader::fail(std::size_t column, const std::string& message) const {
  fail((columns_.empty() ? "column " + std::to_string(column + 1) : "column '" + printable(columns_[column]) + "'") +
       ": " + message);
}

void CsvReader::fail(const std::string& message) const {
  throw Error(name_ + ":" + std::to_string(line_) + ": " + message);
}

}  // namespace asperity
