#include "parse_stylus_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "asperity/base/arrange_on_grid.h"
#include "asperity/base/column_unit.h"
#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "rounding_of_text.h"
#include "text_cells.h"

namespace asperity {
namespace {

constexpr double kMostHeight_m = 10.0;

struct Lines {
  explicit Lines(std::string_view text) : rest(text) {}
  bool next() {
    if (rest.empty()) return false;
    line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    line = trim(line);
    ++number;
    return true;
  }
  std::string_view rest, line;
  std::size_t number = 0;
};

// The lines above the first row of numbers, and that row's number and cells.
struct TableHead {
  std::vector<std::string_view> header;
  std::size_t first_line = 0;
  std::size_t width = 0;  // 0: no row of numbers
  char separator = 0;
};

// Commas part the cells where a header line has a unit between them: else a comma may be a decimal one.
bool commas_part(const std::vector<std::string_view>& header) {
  return std::any_of(header.begin(), header.end(), [](std::string_view line) {
    if (line.find_first_of(";\t") != std::string_view::npos) return false;
    const std::size_t cells = text_cells(line, ',').size();
    return cells > 1 && cells <= 3 && header_units_m(line, cells).has_value();
  });
}

TableHead head_of(std::string_view text, std::size_t most_lines) {
  TableHead out;
  Lines lines(text);
  while (lines.next() && lines.number < most_lines) {
    if (lines.line.empty()) continue;
    const char separator = commas_part(out.header) ? ',' : separator_of(lines.line);
    if (const auto row = number_row(lines.line, separator)) {
      out.first_line = lines.number;
      out.width = row->size();
      out.separator = separator;
      return out;
    }
    out.header.push_back(lines.line);
  }
  return out;
}

// A header that parse_heights() knows itself: names that end in units, as x_mm,z_um.
bool names_end_in_units(std::string_view line) {
  if (line.find_first_of("#%/") == 0) return false;
  const auto cells = text_cells(line, ',');
  return std::all_of(cells.begin(), cells.end(), [](auto cell) { return split_length_name(cell).has_value(); });
}

// A header line of the table's own columns that states a unit which is not a length.
void refuse_other_units(const TableHead& head, const std::string& name) {
  for (const std::string_view line : head.header) {
    const auto cells = text_cells(line, head.separator == ' ' ? separator_of(line) : head.separator);
    if (cells.size() != head.width) continue;
    for (const std::string_view cell : cells) {
      const ColumnUnit stated = column_unit(cell);
      if (stated.is_other()) throw Error(name + ": " + not_a_length(cell, stated.unit));
    }
  }
}

struct TableUnits {
  std::vector<double> metres;  // of each column
  UnitOrigin origin = UnitOrigin::kHeader;
};

// Of the last header line that states them, else of the setting.
TableUnits units_of(const TableHead& head, const std::string& name, const ReadHeightsConfig& config) {
  for (auto line = head.header.rbegin(); line != head.header.rend(); ++line) {
    if (auto units = header_units_m(*line, head.width)) return {std::move(*units), UnitOrigin::kHeader};
  }
  if (!config.units.empty()) {
    if (auto units = header_units_m(config.units, head.width)) return {std::move(*units), UnitOrigin::kSetting};
    throw Error(fmt::format("{}: '{}' does not state the units of its {} columns, as mm,um", name,
                            printable(config.units), head.width));
  }
  refuse_other_units(head, name);
  if (head.width == 1) {
    const ReadUnit unit = setting_unit(config);
    return {{unit.metres}, unit.origin};
  }
  throw Error(
      fmt::format("{}:{}: no header line states the units of its {} columns, as \"x [mm];z [µm]\"; --set "
                  "input.units={} states them",
                  name, head.first_line, head.width, head.width == 2 ? "mm,um" : "mm,mm,um"));
}

struct TableRows {
  std::vector<std::array<double, 3>> points_m;
  std::vector<std::size_t> line;  // of each
};

TableRows rows_of(std::string_view text, const std::string& name, const TableHead& head,
                  const std::vector<double>& unit_m) {
  TableRows out;
  Lines lines(text);
  while (lines.next()) {
    if (lines.number < head.first_line || lines.line.empty()) continue;
    auto row = number_row(lines.line, head.separator);
    if (row && row->size() + 1 == head.width) row->push_back(kNan);  // "0.5;": a point without its height
    if (!row || row->size() != head.width) {
      throw Error(
          fmt::format("{}:{}: '{}' is not a row of {} numbers", name, lines.number, printable(lines.line), head.width));
    }
    std::array<double, 3> point{};
    for (std::size_t k = 0; k < head.width; ++k) {
      point[k] = (*row)[k] * unit_m[k];
      if (std::isinf(point[k]) || std::abs(point[k]) > kMostHeight_m)
        throw Error(fmt::format("{}:{}: '{}' is more than ten metres", name, lines.number, printable(lines.line)));
      if (std::isnan(point[k]) && k + 1 < head.width)
        throw Error(fmt::format("{}:{}: '{}' has no position", name, lines.number, printable(lines.line)));
    }
    out.points_m.push_back(point);
    out.line.push_back(lines.number);
  }
  return out;
}

// Names the first step that is none of `step_m`, else the position `at` that the small errors of many have moved.
[[noreturn]] void fail_uneven(const TableRows& rows, const std::vector<double>& steps_m, double step_m, std::size_t at,
                              const std::string& name) {
  const auto is_even = [&](double step) { return std::abs(step / step_m - std::round(step / step_m)) <= 0.02; };
  const auto odd = std::find_if_not(steps_m.begin(), steps_m.end(), is_even);
  if (odd != steps_m.end()) at = static_cast<std::size_t>(odd - steps_m.begin()) + 1;
  throw Error(fmt::format("{}:{}: its positions are not even: {} m is {} m after the one before, where most are {} m",
                          name, rows.line[at], number_text(rows.points_m[at][0]), number_text(steps_m[at - 1]),
                          number_text(step_m)));
}

// Heights at equal steps; steps without a row are missing.
HeightProfile profile_of(const TableRows& rows, const std::string& name) {
  const auto& points = rows.points_m;
  std::vector<double> steps_m;
  for (std::size_t i = 1; i < points.size(); ++i) {
    steps_m.push_back(points[i][0] - points[i - 1][0]);
    if (!(steps_m.back() > 0.0)) {
      throw Error(fmt::format("{}:{}: its positions do not rise: {} m after {} m", name, rows.line[i],
                              number_text(points[i][0]), number_text(points[i - 1][0])));
    }
  }
  std::vector<double> ordered_m = steps_m;
  const auto middle = ordered_m.begin() + static_cast<std::ptrdiff_t>((ordered_m.size() - 1) / 2);
  std::nth_element(ordered_m.begin(), middle, ordered_m.end());
  const double length_m = points.back()[0] - points.front()[0];
  const double steps = std::round(length_m / *middle);
  constexpr double kMostMissing = 4.0;
  if (!(steps < kMostMissing * static_cast<double>(points.size())))
    throw Error(name + ": its positions are not even: most steps are far shorter than their mean");
  HeightProfile out;
  out.spacing_m = length_m / steps;
  out.height_m.assign(static_cast<std::size_t>(steps) + 1, kNan);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double at = (points[i][0] - points.front()[0]) / out.spacing_m;
    if (!(std::abs(at - std::round(at)) <= 0.01)) fail_uneven(rows, steps_m, *middle, i, name);
    out.height_m[static_cast<std::size_t>(std::round(at))] = points[i][1];
  }
  return out;
}

}  // namespace

bool is_stylus_text(std::string_view text) {
  constexpr std::size_t kLooked_bytes = 65536, kMostLines = 400;
  const TableHead head = head_of(text.substr(0, kLooked_bytes), kMostLines);
  if (head.width == 0) return false;
  if (head.separator == ';' || head.separator == '\t' || head.separator == ' ') return true;
  if (head.header.empty()) return false;
  const auto has_separators = [](std::string_view line) { return line.find_first_of(";\t") != std::string_view::npos; };
  if (head.width == 1 && std::any_of(head.header.begin(), head.header.end(), has_separators)) return true;
  if (names_end_in_units(head.header.back())) return false;
  return std::any_of(head.header.begin(), head.header.end(),
                     [&](std::string_view line) { return header_units_m(line, head.width).has_value(); });
}

bool is_decimal_comma_column(std::string_view text) {
  constexpr std::size_t kMostLines = 400;
  Lines lines(text);
  bool seen = false, with_comma = false;
  while (lines.next() && lines.number < kMostLines) {
    const bool is_number = cell_number(lines.line).has_value();
    if (lines.line.empty() || (!seen && !is_number && lines.line.find(',') == std::string_view::npos)) continue;
    seen = true;
    if (lines.line.find_first_of(".; \t") != std::string_view::npos || !is_number) return false;
    with_comma = with_comma || lines.line.find(',') != std::string_view::npos;
  }
  return with_comma;
}

ReadUnit setting_unit(const ReadHeightsConfig& config) {
  constexpr std::array<double, 5> kMetres{1e-6, 1e-6, 1e-3, 1.0, 1e-9};
  return {kMetres.at(static_cast<std::size_t>(config.unit)),
          config.unit == HeightUnit::kUnstated ? UnitOrigin::kAssumed : UnitOrigin::kSetting};
}

std::string not_a_length(std::string_view column, std::string_view unit) {
  return fmt::format(
      "column '{}': its unit '{}' is not a length that is known; name another column, or state the unit by --set "
      "input.units=um",
      printable(column), printable(unit));
}

Heights parse_stylus_text(std::string_view text, const std::string& name, const ReadHeightsConfig& config,
                          HeightsOrigin& origin) {
  const TableHead head = head_of(text, text.size());
  const TableUnits units = units_of(head, name, config);
  origin.units.height = {units.metres.back(), units.origin};
  if (head.width > 1) origin.units.position = {units.metres.front(), units.origin};
  origin.last_digit_rms_m = 0.5 * units.metres.back() * rounding_step_rms(text, head.separator, head.width - 1);
  const TableRows rows = rows_of(text, name, head, units.metres);
  if (rows.points_m.size() < 2) throw Error(name + ": fewer than two heights");
  if (head.width > 1 && !text.ends_with('\n')) {
    throw Error(
        fmt::format("{}:{}: the file does not end in a newline: its last row may be cut off", name, rows.line.back()));
  }
  if (head.width == 3) {
    if (auto map = arrange_on_grid(rows.points_m)) return std::move(*map);
    throw Error(fmt::format("{}: its {} points are not those of an even grid, each once, or its end was cut off", name,
                            rows.points_m.size()));
  }
  if (head.width == 2) return profile_of(rows, name);
  if (!(config.spacing_m > 0.0)) throw Error(name + ": the spacing of its heights must be given");
  HeightProfile profile;
  profile.spacing_m = config.spacing_m;
  for (const auto& point : rows.points_m) profile.height_m.push_back(point[0]);
  return profile;
}

}  // namespace asperity
