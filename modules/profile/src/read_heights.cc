#include "asperity/profile/read_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asperity/base/arrange_on_grid.h"
#include "asperity/base/column_unit.h"
#include "asperity/base/csv.h"
#include "asperity/base/decode_text.h"
#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/read_areal_map.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/image/tiff_image.h"
#include "asperity/surface/parse_surface_file.h"
#include "parse_stylus_text.h"
#include "rounding_of_text.h"
#include "text_cells.h"

namespace asperity {
namespace {

constexpr std::uint64_t kLargestFile_bytes = 512ULL << 20;
constexpr double kPositionTolerance_steps = 1e-3;

std::size_t choose_column(const CsvReader& table, const ReadHeightsConfig& config) {
  if (!config.column.empty()) {
    const auto found = table.find(config.column);
    if (!found) table.fail("column '" + printable(config.column) + "' is missing");
    return *found;
  }
  for (const char* name : {"texture_m", "height_m"}) {
    if (const auto found = table.find(name)) return *found;
  }
  if (table.width() != 1) {
    std::string names;
    for (const std::string& column : table.columns())
      names += (names.empty() ? "'" : ", '") + printable(column, 40) + "'";
    table.fail(
        "neither a profile (s_m,height_m or x_mm,z_um), one column of heights, nor an areal map (x_mm,y_mm,z_um); with "
        "several columns, one must be chosen by name: --set input.column=NAME" +
        (names.empty() ? names : " of " + names));
  }
  return 0;
}

void take_spacing(const std::vector<double>& s_m, const ReadHeightsConfig& config, const CsvReader& table,
                  HeightProfile& profile) {
  profile.spacing_m = (s_m.back() - s_m.front()) / static_cast<double>(s_m.size() - 1);
  if (!(profile.spacing_m > 0.0)) table.fail("s_m does not rise");
  if (config.spacing_m > 0.0 && std::abs(config.spacing_m - profile.spacing_m) > 1e-6 * profile.spacing_m) {
    table.fail("a spacing of " + number_text(config.spacing_m) + " m is given, but s_m has " +
               number_text(profile.spacing_m));
  }
  for (std::size_t i = 0; i < s_m.size(); ++i) {
    const double expected_m = s_m.front() + static_cast<double>(i) * profile.spacing_m;
    if (!(std::abs(s_m[i] - expected_m) <= kPositionTolerance_steps * profile.spacing_m)) {
      table.fail("s_m is not uniform: row " + std::to_string(i + 1) + " has " + number_text(s_m[i]) + " where " +
                 number_text(expected_m) + " was expected");
    }
  }
}

// What is finite and still no height, or no error of one, of anything that a hand strokes.
constexpr double kLargestHeight_m = 10.0;

double plausible_m(const CsvReader& table, std::size_t column, double unit_m) {
  if (is_missing_word(table.cell(column))) return kNan;
  const double value_m = table.finite_or_nan(column) * unit_m;
  if (std::abs(value_m) > kLargestHeight_m) {
    table.fail(column, "'" + printable(table.cell(column)) + "' is more than ten metres");
  }
  return value_m;
}

// Of two columns x and z by name, as x_mm,z_um in either order: that of x.
std::optional<std::size_t> position_column(const CsvReader& table) {
  if (table.columns().size() != 2) return std::nullopt;
  for (const std::size_t x : {0U, 1U}) {
    const auto along = split_length_name(table.columns()[x]), height = split_length_name(table.columns()[1 - x]);
    if (along && height && along->quantity == "x" && height->quantity == "z") return x;
  }
  return std::nullopt;
}

// Of the chosen column: its name's, else the setting's.
ReadUnit height_unit(const CsvReader& table, std::size_t column, const ReadHeightsConfig& config) {
  const std::string_view name = table.columns().empty() ? std::string_view{} : table.columns()[column];
  const ColumnUnit stated = column_unit(name);
  if (stated.unit_m) {
    const bool is_ours = name == "texture_m" || name == "height_m";
    return {*stated.unit_m, is_ours && table.find("s_m") ? UnitOrigin::kFile : UnitOrigin::kHeader};
  }
  if (!config.units.empty()) {
    if (const auto units = header_units_m(config.units, 1)) return {units->front(), UnitOrigin::kSetting};
    table.fail("'" + printable(config.units) + "' does not state the unit of one column, as um");
  }
  if (stated.is_other()) table.fail(not_a_length(name, stated.unit));
  return setting_unit(config);
}

HeightProfile read_profile_heights(CsvReader& table, std::string_view text, const ReadHeightsConfig& config,
                                   HeightsOrigin& origin) {
  HeightProfile profile;
  auto position = table.find("s_m");
  double position_unit_m = 1.0;
  std::size_t column = 0;
  if (const auto x = config.column.empty() ? position_column(table) : std::nullopt) {
    position = *x;
    position_unit_m = split_length_name(table.columns()[*x])->unit_m;
    column = 1 - *x;
  } else {
    column = choose_column(table, config);
  }
  if (!table.columns().empty()) profile.column = table.columns()[column];
  const auto sigma = profile.column == "texture_m" ? table.find("texture_sigma_m") : std::nullopt;
  origin.units.height = height_unit(table, column, config);
  const double unit_m = origin.units.height.metres;
  origin.last_digit_rms_m = 0.5 * unit_m * rounding_step_rms(text, ',', column);
  if (position) origin.units.position = {position_unit_m, origin.units.height.origin};
  if (position && !text.ends_with('\n')) table.fail("the file does not end in a newline: its last row may be cut off");
  if (!position && !(config.spacing_m > 0.0))
    table.fail("the file has no positions (s_m): the spacing of its heights must be given");
  std::vector<double> s_m;
  while (table.next()) {
    profile.height_m.push_back(plausible_m(table, column, unit_m));
    if (position) s_m.push_back(table.finite_or_nan(*position) * position_unit_m);
    if (s_m.size() > 1 && s_m.back() <= s_m[s_m.size() - 2])
      table.fail(*position, "the positions do not rise: '" + printable(table.cell(*position)) +
                                "' is not above the one before; put the rows in rising order");
    if (sigma) profile.sigma_m.push_back(plausible_m(table, *sigma, 1.0));
  }
  if (profile.height_m.size() < 2) table.fail("fewer than two heights");
  if (position) {
    take_spacing(s_m, config, table, profile);
  } else {
    profile.spacing_m = config.spacing_m;
  }
  return profile;
}

// The units of an areal map's three columns, or nullopt if the columns are not one's.
std::optional<std::array<double, 3>> areal_units_m(const CsvReader& table, const ReadHeightsConfig& config,
                                                   UnitOrigin& origin) {
  if (table.width() != 3) return std::nullopt;
  origin = UnitOrigin::kHeader;
  if (table.columns().empty()) {
    origin = config.units.empty() ? UnitOrigin::kAssumed : UnitOrigin::kSetting;
    if (config.units.empty()) return std::array<double, 3>{1e-3, 1e-3, 1e-6};
    const auto units = header_units_m(config.units, 3);
    if (!units) table.fail("'" + printable(config.units) + "' does not state the units of three columns, as mm,mm,um");
    return std::array<double, 3>{(*units)[0], (*units)[1], (*units)[2]};
  }
  std::array<double, 3> units{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto named = split_length_name(table.columns()[i]);
    if (!named || named->quantity != std::string_view("xyz").substr(i, 1)) return std::nullopt;
    units[i] = named->unit_m;
  }
  return units;
}

// A TIFF's numbers as heights in the config's unit, at the spacing that is given: files state neither of them
// reliably (most programs write 72 pixels an inch, whatever the image is).
ArealMap heights_of_tiff(std::string_view bytes, const std::string& name, const ReadHeightsConfig& config,
                         HeightsOrigin& origin) {
  if (!(config.spacing_m > 0.0)) throw Error(name + ": a TIFF states no spacing of heights: it must be given");
  if (!config.column.empty()) throw Error(name + ": a TIFF has no column '" + printable(config.column) + "'");
  TiffImage image = parse_tiff(bytes, name);
  ArealMap map{config.spacing_m, config.spacing_m, image.columns, image.rows, std::move(image.values)};
  origin.units.height = setting_unit(config);
  const double unit_m = origin.units.height.metres;
  for (std::size_t i = 0; i < map.height_m.size(); ++i) {
    map.height_m[i] *= unit_m;
    if (std::abs(map.height_m[i]) > kLargestHeight_m) {
      throw Error(name + ": the height of point " + std::to_string(i % map.columns + 1) + " of row " +
                  std::to_string(i / map.columns + 1) + " is " + number_text(map.height_m[i]) + " m");
    }
  }
  return map;
}

// The points in any order, where they are not in that of a full grid.
ArealMap areal_map_of(std::string_view text, const std::string& name, const std::array<double, 3>& unit_m) {
  CsvReader in_order(text, name, CsvHeader::kOptional);
  in_order.accept_unterminated();
  try {
    return read_areal_map(in_order, unit_m);
  } catch (const Error&) {
    if (!text.ends_with('\n')) throw;
    CsvReader table(text, name, CsvHeader::kOptional);
    std::vector<std::array<double, 3>> points_m;
    while (table.next()) {
      points_m.push_back({});
      for (std::size_t k = 0; k < 3; ++k) points_m.back()[k] = plausible_m(table, k, unit_m[k]);
      if (std::isnan(points_m.back()[0]) || std::isnan(points_m.back()[1])) throw;
    }
    auto map = arrange_on_grid(points_m);
    if (!map) throw;
    return std::move(*map);
  }
}

[[noreturn]] void refuse_image(const std::string& name) {
  throw Error(name +
              ": a picture (PNG, JPEG) states neither the spacing nor the range of its heights; asperity feel "
              "--height-maps takes it, and a TIFF of heights is read here");
}

bool is_picture(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n") || bytes.starts_with("\xff\xd8\xff");
}

HeightProfile profile_of_map(ArealMap map, const std::string& name) {
  HeightProfile profile;
  profile.height_m = std::move(map.height_m);
  profile.spacing_m = map.x_spacing_m;
  if (profile.height_m.size() < 2) throw Error(name + ": fewer than two heights");
  return profile;
}

Heights parse_text_heights(std::string_view text, const std::string& name, const ReadHeightsConfig& config,
                           HeightsOrigin& origin) {
  if (config.column.empty() && (is_stylus_text(text) || (config.spacing_m > 0.0 && is_decimal_comma_column(text))))
    return parse_stylus_text(text, name, config, origin);
  CsvReader table(text, name, CsvHeader::kOptional);
  table.accept_unterminated();
  UnitOrigin stated{};
  if (const auto units = areal_units_m(table, config, stated)) {
    origin.units = {{(*units)[2], stated}, {(*units)[0], stated}};
    origin.last_digit_rms_m = 0.5 * (*units)[2] * rounding_step_rms(text, ',', 2);
    return areal_map_of(text, name, *units);
  }
  return read_profile_heights(table, text, config, origin);
}

const std::vector<double>& height_of(const Heights& heights) {
  const auto* map = std::get_if<ArealMap>(&heights);
  return map != nullptr ? map->height_m : std::get<HeightProfile>(heights).height_m;
}

// Of numbers that all are floats, as GSF has them: half of the last bit of the largest.
double rounding_of_floats_m(const std::vector<double>& height_m) {
  double largest_m = 0.0;
  for (const double z : height_m) {
    if (!std::isfinite(z)) continue;
    if (static_cast<double>(static_cast<float>(z)) != z) return 0.0;
    largest_m = std::max(largest_m, std::abs(z));
  }
  return 0.5 * std::numeric_limits<float>::epsilon() * largest_m;
}

// Heights that all are the lowest, or the highest, far outside the others: what a program wrote for missing points.
void find_sentinel(const std::vector<double>& height_m, const std::string& name, Problems& problems) {
  constexpr double kFar = 10.0;  // spans of the others
  for (const double sign : {1.0, -1.0}) {
    double lowest = HUGE_VAL, next = HUGE_VAL, highest = -HUGE_VAL;
    std::size_t count = 0, present = 0;
    for (const double height : height_m) {
      if (std::isnan(height)) continue;
      const double z = sign * height;
      ++present;
      highest = std::max(highest, z);
      if (z < lowest) {
        next = lowest;
        lowest = z;
        count = 1;
      } else if (z == lowest) {
        ++count;
      } else {
        next = std::min(next, z);
      }
    }
    const double span = highest - next;
    if (count < 2 || 2 * count > present || !(span > 0.0) || !(next - lowest > kFar * span)) continue;
    problems.push_back({"sentinel",
                        name + ": " + std::to_string(count) + " heights are all " + number_text(sign * lowest) +
                            " m, far outside the others; they count as heights. If they stand for missing points, "
                            "write nan for them",
                        count});
  }
}

// No instrument measures heights that span far more than what it moves over: their unit is another.
void check_span(const Heights& heights, const std::string& name) {
  constexpr double kMostSpan = 100.0;
  constexpr std::size_t kLeastHeights = 16;  // fewer are an example
  const auto* map = std::get_if<ArealMap>(&heights);
  const auto& height_m = height_of(heights);
  if (height_m.size() < kLeastHeights) return;
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (const double z : height_m) {
    if (std::isnan(z)) continue;
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
  }
  const auto side = [](std::size_t count, double spacing_m) { return static_cast<double>(count) * spacing_m; };
  const double length_m = map != nullptr
                              ? std::max(side(map->columns, map->x_spacing_m), side(map->rows, map->y_spacing_m))
                              : side(height_m.size(), std::get<HeightProfile>(heights).spacing_m);
  if (highest - lowest > kMostSpan * length_m) {
    throw Error(name + ": its heights span " + number_text(highest - lowest) + " m over a length of " +
                number_text(length_m) + " m: their unit or the spacing is another");
  }
}

}  // namespace

Heights parse_heights(std::string_view text, const std::string& name, const ReadHeightsConfig& config,
                      Problems* problems, HeightsOrigin* origin) {
  Heights out;
  HeightsOrigin found{{{1.0, UnitOrigin::kFile}, {}}};
  bool is_binary = true;
  if (auto file = parse_surface_file(text, name)) {
    if (problems != nullptr) problems->insert(problems->end(), file->problems.begin(), file->problems.end());
    out = std::move(file->map);
  } else if (is_tiff(text)) {
    out = heights_of_tiff(text, name, config, found);
  } else if (is_picture(text)) {
    refuse_image(name);
  } else {
    is_binary = false;
    std::string decoded = decode_text(std::string(text), name).text;
    while (decoded.ends_with('\x1a')) decoded.pop_back();  // the end of a file of DOS
    out = parse_text_heights(decoded, name, config, found);
  }
  if (auto* map = std::get_if<ArealMap>(&out); map != nullptr && map->rows == 1)
    out = profile_of_map(std::move(*map), name);
  check_span(out, name);
  if (problems != nullptr) find_sentinel(height_of(out), name, *problems);
  if (origin != nullptr) {
    found.arithmetic_rms_m = arithmetic_rms_m(height_of(out));
    if (is_binary) found.last_digit_rms_m = rounding_of_floats_m(height_of(out));
    *origin = found;
  }
  return out;
}

Heights read_heights(const std::filesystem::path& path, const ReadHeightsConfig& config, Problems* problems,
                     HeightsOrigin* origin) {
  return parse_heights(read_file(path, kLargestFile_bytes), path.string(), config, problems, origin);
}

bool is_stylus_table(std::string_view text) { return is_stylus_text(text); }

bool is_decimal_comma_table(std::string_view text) { return is_decimal_comma_column(text); }

}  // namespace asperity
