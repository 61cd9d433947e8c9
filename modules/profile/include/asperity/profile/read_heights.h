#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "asperity/base/areal_map.h"
#include "asperity/base/problem.h"
#include "asperity/profile/heights_units.h"

namespace asperity {

// kUnstated: nobody has stated it, µm is assumed.
enum class HeightUnit { kUnstated, kMicrometre, kMillimetre, kMetre, kNanometre };
inline constexpr std::array<std::string_view, 5> kHeightUnitNames{"unstated", "um", "mm", "m", "nm"};

struct ReadHeightsConfig {
  double spacing_m = 0.0;
  std::string column{};
  HeightUnit unit = HeightUnit::kUnstated;
  std::string units{};

  template <class V>
  void visit(V& v) {
    v.field("spacing_m", spacing_m,
            "distance of the heights, for files without positions (one column, TIFF); 0: not given", {0.0, 1.0});
    v.field("column", column, "the column of heights; empty: texture_m, else height_m, else the only one");
    v.choice("unit", unit, kHeightUnitNames,
             "of a column whose name states no unit, and of a TIFF; unstated: um is assumed");
    v.field("units", units,
            "of a table's columns where no header line states lengths: mm,um or mm,mm,um; of one column um");
  }
};

// Heights along a line, as a file gave them; nan where missing.
struct HeightProfile {
  std::vector<double> height_m;
  double spacing_m = 0.0;
  std::string column;           // its name in the file; empty if it had none
  std::vector<double> sigma_m;  // of texture_m in a file with texture_sigma_m; else empty
};

using Heights = std::variant<HeightProfile, ArealMap>;

// Heights from an instrument's file (GSF, SDF, SUR, X3P, SMD: surface/parse_surface_file.h), from a TIFF
// (image/tiff_image.h: its numbers times `unit`, at `spacing_m` along both sides, nan where a float is nan), or from a
// text file of one of these kinds, told apart by their first line:
//   s_m,height_m,texture_m,…   a profile.csv, uniform in s_m
//   x_mm,z_um                  positions and heights in either order, units by name
//   height                     one column, with or without a header; needs `spacing_m`. Its name or that of the chosen
//                              column states the unit in any way that base/column_unit.h knows ("z_nm", "Height [Å]");
//                              one that is not a length is refused
//   x_mm,y_mm,z_µm             an areal map with or without that header (other units by name), blank lines allowed;
//                              rows along x or along y, or points in any order, of which some may be left out
//                              (base/arrange_on_grid.h)
//   header lines, then x and z a row, z alone, or x, y and z: what stylus instruments and other programs export,
//                              separated by semicolons, tabs, blanks or commas, with decimal points or commas; units by
//                              a word of the last header lines, as [µm] or (mm), else by `units`
// Text is UTF-8, UTF-16 with a byte order mark, or Latin-1. Throws Error naming file, line and value for anything else,
// infinite numbers, uneven positions, a spacing that is missing or contradicts s_m, 16 or more heights that span more
// than a hundred times the length and width (another unit is meant), or a file of more than 512 MiB. A checksum that
// does not hold is a problem ("checksum"), and so are equal heights far outside the others ("sentinel"). `origin`
// receives the units that were used, and where they come from.
Heights read_heights(const std::filesystem::path& path, const ReadHeightsConfig& config = {},
                     Problems* problems = nullptr, HeightsOrigin* origin = nullptr);

// The same from text in memory; `name` is what messages call it.
Heights parse_heights(std::string_view text, const std::string& name, const ReadHeightsConfig& config = {},
                      Problems* problems = nullptr, HeightsOrigin* origin = nullptr);

// Whether decoded text (base/decode_text.h) is a table of the last kind: for readers of plain tables of their own.
bool is_stylus_table(std::string_view text);

// Whether its lines are single numbers with decimal commas.
bool is_decimal_comma_table(std::string_view text);

}  // namespace asperity
