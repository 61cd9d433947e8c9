#include "text_cells.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "asperity/base/column_unit.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

constexpr std::string_view kBlanks = " \t";

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

// Metres of the unit that a header's cell states: all of it, or what column_unit() finds.
std::optional<double> unit_of(std::string_view cell) {
  while (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') cell = trim(cell.substr(1, cell.size() - 2));
  if (cell.size() > 1 && (cell.front() == '[' || cell.front() == '(')) return column_unit(cell).unit_m;
  if (const auto whole = length_of_unit_m(cell)) return whole;
  return column_unit(cell).unit_m;
}

// Words of a sentence that are units too.
bool is_prose(std::string_view word) {
  for (const std::string_view one : {"in", "foot", "feet", "thou", "mic", "ang"}) {
    if (same_word(word, one)) return true;
  }
  return false;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> out;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return out;
    line.remove_prefix(begin);
    out.push_back(line.substr(0, line.find_first_of(kBlanks)));
    line.remove_prefix(out.back().size());
  }
}

}  // namespace

char separator_of(std::string_view line) {
  for (const char c : {';', '\t'}) {
    if (line.find(c) != std::string_view::npos) return c;
  }
  if (words_of(line).size() > 1) {
    return line.find(',') != std::string_view::npos && line.find(", ") != std::string_view::npos ? ',' : ' ';
  }
  // One comma may be a decimal comma: commas part only cells of which one has a decimal point, or three cells.
  const auto commas = std::count(line.begin(), line.end(), ',');
  return commas > 1 || (commas == 1 && line.find('.') != std::string_view::npos) ? ',' : '\0';
}

std::vector<std::string_view> text_cells(std::string_view line, char separator) {
  if (separator == ' ') return words_of(line);
  std::vector<std::string_view> out;
  while (true) {
    const std::size_t end = separator == 0 ? std::string_view::npos : line.find(separator);
    out.push_back(trim(line.substr(0, end)));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  if (out.size() > 1 && out.back().empty()) out.pop_back();  // a separator at the end
  return out;
}

std::optional<double> cell_number(std::string_view cell) {
  if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') cell = trim(cell.substr(1, cell.size() - 2));
  std::string text(cell);
  if (std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == std::string::npos)
    std::replace(text.begin(), text.end(), ',', '.');
  return parse_double(text);
}

bool is_missing_word(std::string_view cell) {
  if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') cell = trim(cell.substr(1, cell.size() - 2));
  if (cell.find_first_not_of("-*") == std::string_view::npos) return true;
  for (const std::string_view word : {"nan", "na", "n/a", "null", "bad", "no data", "nodata", "missing"}) {
    if (same_word(cell, word)) return true;
  }
  return false;
}

std::optional<std::vector<double>> number_row(std::string_view line, char separator) {
  const auto cells = text_cells(line, separator);
  if (cells.empty() || cells.size() > 3) return std::nullopt;
  std::vector<double> out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto value = cell_number(cells[i]);
    const bool missing = !value && i > 0 && i + 1 == cells.size() && is_missing_word(cells[i]);
    if (!value && !missing) return std::nullopt;
    out.push_back(value.value_or(kNan));
  }
  return out;
}

std::optional<std::vector<double>> header_units_m(std::string_view line, std::size_t width) {
  for (const char separator : {';', '\t', ','}) {
    const auto cells = text_cells(line, separator);
    if (cells.size() < 2 || cells.size() != width) continue;
    std::vector<double> out;
    for (const std::string_view cell : cells) {
      if (const auto unit = unit_of(cell)) out.push_back(*unit);
    }
    if (out.size() == width) return out;
  }
  if (line.find_first_of(";,") != std::string_view::npos && width > 1) return std::nullopt;
  // "x [mm]  z [µm]": names and units are words. In "length 4.8 mm" the unit is the number's.
  const auto words = words_of(line);
  const bool has_number =
      std::any_of(words.begin(), words.end(), [](auto word) { return cell_number(word).has_value(); });
  std::vector<double> out;
  for (const std::string_view word : words) {
    const bool in_brackets = word.ends_with(']') || word.ends_with(')');
    if (!in_brackets && (has_number || is_prose(word))) continue;
    if (const auto unit = unit_of(word)) out.push_back(*unit);
  }
  return out.size() == width ? std::optional(out) : std::nullopt;
}

}  // namespace asperity
