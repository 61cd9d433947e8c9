#include "parse_stylus_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

constexpr double kMostHeight_m = 10.0;

// The separator of a line, or 0.
char separator_of(std::string_view line) {
  for (const char c : {';', '\t'}) {
    if (line.find(c) != std::string_view::npos) return c;
  }
  return 0;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
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

// With a decimal comma or point.
std::optional<double> number_of(std::string_view cell) {
  std::string text(cell);
  if (std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == std::string::npos)
    std::replace(text.begin(), text.end(), ',', '.');
  return parse_double(text);
}

struct Lines {
  explicit Lines(std::string_view text) : rest(text) {
    if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  }
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

// Metres of the unit that a header's cell states: the last word of it, without brackets.
std::optional<double> unit_of(std::string_view cell) {
  while (!cell.empty() && std::string_view("])\"").find(cell.back()) != std::string_view::npos) cell.remove_suffix(1);
  const std::size_t begin = cell.find_last_of(" [(_/\"");
  const std::string_view word = begin == std::string_view::npos ? cell : cell.substr(begin + 1);
  struct Unit {
    std::string_view name;
    double metres;
  };
  static constexpr std::array<Unit, 8> kUnits{{{"nm", 1e-9},
                                               {"um", 1e-6},
                                               {"\xc2\xb5m", 1e-6},
                                               {"\xce\xbcm", 1e-6},
                                               {"\xb5m", 1e-6},
                                               {"mm", 1e-3},
                                               {"cm", 1e-2},
                                               {"m", 1.0}}};
  for (const Unit& unit : kUnits) {
    if (word == unit.name) return unit.metres;
  }
  return std::nullopt;
}

// A row of numbers; its last cell may be empty or a word for a missing height.
std::optional<std::vector<double>> row_of(std::string_view line, char separator) {
  std::vector<double> out;
  const auto cells = cells_of(line, separator);
  if (cells.empty() || cells.size() > 3) return std::nullopt;
  for (const std::string_view cell : cells) {
    const auto value = number_of(cell);
    if (!value) return std::nullopt;
    out.push_back(*value);
  }
  return out;
}

Heights grid_of(const std::vector<std::array<double, 3>>& rows, const std::string& name) {
  ArealMap map;
  while (map.columns < rows.size() && rows[map.columns][1] == rows[0][1]) ++map.columns;
  if (map.columns < 2 || rows.size() % map.columns != 0 || rows.size() == map.columns)
    throw Error(fmt::format("{}: its {} points are not a full grid of rows along x", name, rows.size()));
  map.rows = rows.size() / map.columns;
  map.x_spacing_m = (rows[map.columns - 1][0] - rows[0][0]) / static_cast<double>(map.columns - 1);
  map.y_spacing_m = (rows.back()[1] - rows[0][1]) / static_cast<double>(map.rows - 1);
  if (!(map.x_spacing_m > 0.0) || !(map.y_spacing_m > 0.0)) throw Error(name + ": x or y does not rise");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double x = rows[0][0] + static_cast<double>(i % map.columns) * map.x_spacing_m;
    const double y = rows[0][1] + static_cast<double>(i / map.columns) * map.y_spacing_m;
    if (!(std::abs(rows[i][0] - x) <= 0.01 * map.x_spacing_m && std::abs(rows[i][1] - y) <= 0.01 * map.y_spacing_m))
      throw Error(fmt::format("{}: point {} is not on an even grid of {} x {}", name, i + 1, map.columns, map.rows));
    map.height_m.push_back(rows[i][2]);
  }
  return map;
}

}  // namespace

bool is_stylus_text(std::string_view text) {
  constexpr std::size_t kLooked_bytes = 65536, kMostLines = 400;
  Lines lines(text.substr(0, kLooked_bytes));
  bool seen = false;
  while (lines.next() && lines.number < kMostLines) {
    const char separator = separator_of(lines.line);
    seen = seen || separator != 0;
    if (lines.line.empty() || !row_of(lines.line, separator)) continue;
    if (separator != 0) return true;
    return seen;  // one column below header lines with separators
  }
  return false;
}

Heights parse_stylus_text(std::string_view text, const std::string& name, const ReadHeightsConfig& config) {
  Lines lines(text);
  std::vector<std::vector<std::string_view>> header;
  std::vector<std::array<double, 3>> rows;
  std::array<double, 3> unit_m{};
  std::size_t width = 0, first_line = 0;
  while (lines.next()) {
    const char separator = separator_of(lines.line);
    auto row = row_of(lines.line, separator);
    if (width == 0) {
      if (!row) {
        if (!lines.line.empty()) header.push_back(cells_of(lines.line, separator));
        continue;
      }
      width = row->size();
      first_line = lines.number;
      // The last header line that states a unit for each column.
      bool found = false;
      for (auto line = header.rbegin(); line != header.rend() && !found; ++line) {
        if (line->size() != width) continue;
        found = true;
        for (std::size_t k = 0; k < width; ++k) {
          const auto unit = unit_of((*line)[k]);
          found = found && unit.has_value();
          unit_m[k] = unit.value_or(0.0);
        }
      }
      if (!found && width > 1) {
        throw Error(fmt::format("{}:{}: no header line states the units of its {} columns, as \"x [mm];z [µm]\"", name,
                                lines.number, width));
      }
      constexpr std::array<double, 4> kMetres{1e-6, 1e-3, 1.0, 1e-9};
      if (!found) unit_m[0] = kMetres.at(static_cast<std::size_t>(config.unit));
    }
    // A point without its height.
    if (!row && width > 1) {
      auto cells = cells_of(lines.line, separator);
      if (cells.size() == width) cells.pop_back();
      std::vector<double> places;
      for (const std::string_view cell : cells) {
        if (const auto value = number_of(cell)) places.push_back(*value);
      }
      if (places.size() + 1 == width) row = places, row->push_back(kNan);
    }
    if (row && row->size() + 1 == width) row->push_back(kNan);
    if (!row || row->size() != width) {
      if (lines.line.empty()) continue;
      throw Error(
          fmt::format("{}:{}: '{}' is not a row of {} numbers", name, lines.number, printable(lines.line), width));
    }
    std::array<double, 3> point{};
    for (std::size_t k = 0; k < width; ++k) {
      const double value = (*row)[k] * unit_m[k];
      if (std::isinf(value) || std::abs(value) > kMostHeight_m)
        throw Error(fmt::format("{}:{}: '{}' is more than ten metres", name, lines.number, printable(lines.line)));
      if (std::isnan(value) && k + 1 < width)
        throw Error(fmt::format("{}:{}: '{}' has no position", name, lines.number, printable(lines.line)));
      point[k] = value;
    }
    rows.push_back(point);
  }
  if (rows.size() < 2) throw Error(name + ": fewer than two heights");
  if (width == 3) return grid_of(rows, name);
  HeightProfile profile;
  for (const auto& point : rows) profile.height_m.push_back(point[width - 1]);
  if (width == 1) {
    if (!(config.spacing_m > 0.0)) throw Error(name + ": the spacing of its heights must be given");
    profile.spacing_m = config.spacing_m;
    return profile;
  }
  profile.spacing_m = (rows.back()[0] - rows[0][0]) / static_cast<double>(rows.size() - 1);
  if (!(profile.spacing_m > 0.0)) throw Error(name + ": its positions do not rise");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double expected_m = rows[0][0] + static_cast<double>(i) * profile.spacing_m;
    if (!(std::abs(rows[i][0] - expected_m) <= 0.01 * profile.spacing_m)) {
      throw Error(
          fmt::format("{}: its positions are not even: row {} of the data (from line {}) has {} m where {} m was "
                      "expected",
                      name, i + 1, first_line, number_text(rows[i][0]), number_text(expected_m)));
    }
  }
  return profile;
}

}  // namespace asperity
