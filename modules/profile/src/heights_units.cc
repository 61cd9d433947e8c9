#include "asperity/profile/heights_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "asperity/base/text.h"

namespace asperity {
namespace {

const char* words_of(UnitOrigin origin) {
  switch (origin) {
    case UnitOrigin::kFile:
      return "the file's";
    case UnitOrigin::kHeader:
      return "by the header";
    case UnitOrigin::kSetting:
      return "as set";
    default:
      return "assumed";
  }
}

std::string one_text(const char* what, const ReadUnit& unit) {
  return fmt::format("{} in {} ({})", what, length_unit_name(unit.metres), words_of(unit.origin));
}

}  // namespace

double arithmetic_rms_m(const std::vector<double>& height_m) {
  constexpr double kBits = 64.0;
  double largest_m = 0.0;
  for (const double z : height_m) {
    if (std::isfinite(z)) largest_m = std::max(largest_m, std::abs(z));
  }
  return kBits * std::numeric_limits<double>::epsilon() * largest_m;
}

std::string length_unit_name(double metres) {
  struct Name {
    double metres;
    std::string_view text;
  };
  constexpr double kInch_m = 0.0254;
  static constexpr std::array<Name, 12> kNames{{{1.0, "m"},
                                                {1e-1, "dm"},
                                                {1e-2, "cm"},
                                                {1e-3, "mm"},
                                                {1e-6, "µm"},
                                                {1e-9, "nm"},
                                                {1e-10, "Å"},
                                                {1e-12, "pm"},
                                                {kInch_m, "in"},
                                                {1e-3 * kInch_m, "mil"},
                                                {1e-6 * kInch_m, "µin"},
                                                {0.3048, "ft"}}};
  constexpr double kSame = 1e-9;
  for (const Name& name : kNames) {
    if (std::abs(metres - name.metres) <= kSame * name.metres) return std::string(name.text);
  }
  return number_text(metres) + " m";
}

std::string unit_origin_name(UnitOrigin origin) {
  constexpr std::array<std::string_view, 4> kNames{"file", "header", "setting", "assumed"};
  return std::string(kNames.at(static_cast<std::size_t>(origin)));
}

std::string units_text(const HeightsUnits& units) {
  std::string out = one_text("heights", units.height);
  const bool has_positions = units.position.metres > 0.0;
  if (has_positions) out += ", " + one_text("positions", units.position);
  const bool height = units.height.origin == UnitOrigin::kAssumed;
  if (has_positions && units.position.origin == UnitOrigin::kAssumed)
    return out + "; --set input.units=mm,mm,um states them";
  return height ? out + "; --set input.unit=nm states another" : out;
}

}  // namespace asperity
