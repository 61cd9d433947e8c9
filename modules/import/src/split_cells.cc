#include "split_cells.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "asperity/base/text.h"
#include "asperity/import/delimited_table.h"
#include "parse_time.h"

namespace asperity {

namespace {

constexpr std::string_view kBlanks = " \t";

std::string_view bare_cell(std::string_view cell) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!cell.empty() && is_blank(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && is_blank(cell.back())) cell.remove_suffix(1);
  return cell;
}

std::size_t end_of_cell(std::string_view line, std::size_t from, char separator) {
  return std::min(separator == ' ' ? line.find_first_of(kBlanks, from) : line.find(separator, from), line.size());
}

// Where the quote that begins at `from` closes; npos if it does not.
std::size_t closing_quote(std::string_view line, std::size_t from) {
  for (std::size_t at = line.find('"', from + 1); at != std::string_view::npos; at = line.find('"', at + 2)) {
    if (at + 1 >= line.size() || line[at + 1] != '"') return at;
  }
  return std::string_view::npos;
}

}  // namespace

bool split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (separator == ' ') line = bare_cell(line);
  std::size_t at = 0;
  while (true) {
    const std::size_t start = std::min(line.find_first_not_of(separator == '\t' ? " " : kBlanks, at), line.size());
    if (start < line.size() && line[start] == '"') {
      const std::size_t close = closing_quote(line, start);
      if (close == std::string_view::npos) return false;
      cells.push_back(bare_cell(line.substr(start + 1, close - start - 1)));
      at = end_of_cell(line, close + 1, separator);
    } else {
      const std::size_t end = end_of_cell(line, separator == ' ' ? start : at, separator);
      const std::size_t begin = std::min(start, end);
      cells.push_back(bare_cell(line.substr(begin, end - begin)));
      at = end;
    }
    if (at >= line.size()) return true;
    ++at;
    if (separator == ' ') at = std::min(line.find_first_not_of(kBlanks, at), line.size());
  }
}

bool is_comment_line(std::string_view line) {
  const std::string_view content = bare_cell(line);
  return content.starts_with('#') || content.starts_with('%') || content.starts_with("//");
}

bool is_missing_cell(std::string_view cell) {
  if (cell.empty()) return true;
  constexpr std::size_t kLongest = 6;
  if (cell.size() > kLongest) return false;
  std::string lower;
  for (const char c : cell) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  constexpr std::array<std::string_view, 9> kNames{"nan", "na", "n/a", "null", "none", "-", "--", "-nan", "#n/a"};
  return std::find(kNames.begin(), kNames.end(), lower) != kNames.end();
}

ParsedCell parse_cell(std::string_view cell) {
  ParsedCell out;
  if (is_missing_cell(cell)) {
    out.kind = CellKind::kMissing;
    return out;
  }
  const auto comma = cell.find(',');
  constexpr std::size_t kLongestNumber = 64;
  if (cell.size() <= kLongestNumber && (comma == std::string_view::npos || cell.find(',', comma + 1) == cell.npos)) {
    char buffer[kLongestNumber];
    std::copy(cell.begin(), cell.end(), buffer);
    if (comma != std::string_view::npos) buffer[comma] = '.';
    out.has_comma = comma != std::string_view::npos;
    out.has_point = cell.find('.') != std::string_view::npos;
    const auto value = parse_double({buffer, cell.size()});
    if (value && std::isfinite(*value)) {
      out.kind = CellKind::kNumber;
      out.value = *value;
      return out;
    }
  }
  out.has_comma = out.has_point = false;
  if (parse_date_time_ns(cell)) out.kind = CellKind::kTime;
  return out;
}

}  // namespace asperity
