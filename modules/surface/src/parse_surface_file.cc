#include "asperity/surface/parse_surface_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "asperity/base/text.h"
#include "surface_formats.h"

namespace asperity {

std::size_t checked_count(std::size_t columns, std::size_t rows, const std::string& name) {
  if (columns == 0 || rows == 0 || columns > kMostHeights / rows)
    throw Error(fmt::format("{}: a grid of {} x {} heights is empty or too large", name, columns, rows));
  return columns * rows;
}

double length_unit_m(std::string_view unit, const std::string& what, const std::string& name) {
  struct Unit {
    std::string_view name;
    double metres;
  };
  // \xb5 is the µ of Latin-1, \xc2\xb5 and \xce\xbc the two of UTF-8; \xc5 and \xc3\x85 are Å.
  static constexpr std::array<Unit, 18> kUnits{{{"m", 1.0},
                                                {"cm", 1e-2},
                                                {"mm", 1e-3},
                                                {"um", 1e-6},
                                                {"\xc2\xb5m", 1e-6},
                                                {"\xce\xbcm", 1e-6},
                                                {"\xb5m", 1e-6},
                                                {"micron", 1e-6},
                                                {"microns", 1e-6},
                                                {"nm", 1e-9},
                                                {"pm", 1e-12},
                                                {"A", 1e-10},
                                                {"\xc5", 1e-10},
                                                {"\xc3\x85", 1e-10},
                                                {"in", 0.0254},
                                                {"inch", 0.0254},
                                                {"metre", 1.0},
                                                {"meter", 1.0}}};
  const std::string_view word = trim(unit.substr(0, unit.find('\0')));
  for (const Unit& one : kUnits) {
    if (word == one.name) return one.metres;
  }
  throw Error(name + ": the unit of " + what + " is '" + printable(word) + "', which is not a known unit of length");
}

double checked_spacing_m(double spacing_m, const std::string& what, const std::string& name) {
  constexpr double kLargest_m = 10.0;
  if (!(spacing_m > 0.0) || !(spacing_m < kLargest_m))
    throw Error(name + ": " + what + " is " + number_text(spacing_m) + " m");
  return spacing_m;
}

std::optional<SurfaceFile> parse_surface_file(std::string_view bytes, const std::string& name) {
  std::optional<SurfaceFile> out;
  if (is_gsf(bytes)) out = parse_gsf(bytes, name);
  if (is_sdf(bytes)) out = parse_sdf(bytes, name);
  if (is_sur(bytes)) out = parse_sur(bytes, name);
  if (is_x3p(bytes)) out = parse_x3p(bytes, name);
  if (is_smd(bytes)) out = parse_smd(bytes, name);
  if (!out) return std::nullopt;
  constexpr double kLargestHeight_m = 10.0;
  const ArealMap& map = out->map;
  for (std::size_t i = 0; i < map.height_m.size(); ++i) {
    if (std::abs(map.height_m[i]) <= kLargestHeight_m || std::isnan(map.height_m[i])) continue;
    throw Error(fmt::format("{}: the height of point {} of row {} is {} m", name, i % map.columns + 1,
                            i / map.columns + 1, number_text(map.height_m[i])));
  }
  return out;
}

}  // namespace asperity
