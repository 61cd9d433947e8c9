#pragma once

#include <optional>
#include <string_view>

namespace asperity {

// What the name of a column states of its unit.
struct ColumnUnit {
  std::string_view quantity;     // the name without the unit, brackets and quotes
  std::string_view unit;         // the unit as it is written there; empty: none is stated
  std::optional<double> unit_m;  // how long it is; nullopt: none is stated, or it is not a length

  bool is_other() const { return !unit.empty() && !unit_m; }  // a unit that is not a length
};

// The unit is what is in brackets ("Height [nm]", "z (Å)"), else the last word if it is one ("HEIGHT_NM", "Height mm",
// "z/µm", "z_V"). Letters of either case, except Nm: that is a torque. Words: length_of_unit_m(). Without brackets "A",
// which is a name as often as an ampere, and words that are not units, are not taken for units.
ColumnUnit column_unit(std::string_view name);

// Metres of a unit of length: Å, pm, nm, µm (um), mm, cm, dm, m, µin, mil, in, ft, and their words in English
// ("micron", "inches"). nullopt for any other text.
std::optional<double> length_of_unit_m(std::string_view unit);

}  // namespace asperity
