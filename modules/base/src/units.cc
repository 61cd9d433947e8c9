#include "asperity/base/units.h"

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/length_unit_names.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

using Unit = std::pair<std::string_view, double>;

constexpr std::array<Unit, 7> kLengths{
    {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"µm", 1e-6}, {"μm", 1e-6}, {"nm", 1e-9}}};
constexpr std::array<Unit, 4> kDurations{{{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"min", 60.0}}};
constexpr std::array<Unit, 3> kSpeeds{{{"m/s", 1.0}, {"cm/s", 1e-2}, {"mm/s", 1e-3}}};

double parse_quantity(std::string_view text, std::string_view what, std::span<const Unit> units,
                      std::string_view example) {
  const std::string_view all = trim(text);
  const auto split = all.find_first_not_of("+-0123456789.eE");
  const auto number = parse_double(all.substr(0, split));
  const std::string_view name = split == std::string_view::npos ? std::string_view{} : trim(all.substr(split));
  for (const auto& [unit, factor] : units) {
    if (number && name == unit && std::isfinite(*number)) {
      // Division by an exact power of ten is correctly rounded where multiplication by 1e-3 is not.
      return factor < 1.0 ? *number / std::round(1.0 / factor) : *number * factor;
    }
  }
  throw Error(std::string(what) + ": '" + printable(text) + "' is not a number with a unit, such as " +
              std::string(example));
}

}  // namespace

double parse_length_m(std::string_view text, std::string_view what) {
  return parse_quantity(text, what, kLengths, "5mm or 0.3m");
}
double parse_speed_mps(std::string_view text, std::string_view what) {
  return parse_quantity(text, what, kSpeeds, "25mm/s");
}
double parse_duration_s(std::string_view text, std::string_view what) {
  return parse_quantity(text, what, kDurations, "10s or 250ms");
}

std::vector<std::string_view> length_unit_names() {
  std::vector<std::string_view> out;
  for (const auto& [name, metres] : kLengths) {
    if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyz") == std::string_view::npos) out.push_back(name);
  }
  return out;
}

double parse_length_unit_m(std::string_view text, std::string_view what) {
  constexpr double kLeast_m = 1e-9, kMost_m = 1e3;
  const bool is_name = !text.empty() && text.find_first_of("0123456789+-.") == std::string_view::npos;
  const double unit_m = parse_length_m(is_name ? "1" + std::string(text) : std::string(text), what);
  if (!(unit_m >= kLeast_m && unit_m <= kMost_m)) {
    throw Error(std::string(what) + ": '" + printable(text) + "' is not between 1 nm and 1000 m");
  }
  return unit_m;
}

std::optional<NamedLength> split_length_name(std::string_view column) {
  const auto end = column.rfind('_');
  if (end == std::string_view::npos) return std::nullopt;
  for (const auto& [unit, metres] : kLengths) {
    if (column.substr(end + 1) == unit) return NamedLength{column.substr(0, end), metres};
  }
  return std::nullopt;
}

}  // namespace asperity
