#include "asperity/import/import_unit.h"

#include <cmath>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"

namespace asperity {

namespace {

struct UnitWords {
  std::string_view name;   // as it is written
  std::string_view words;  // what else it is called, without blanks, ^ and superscripts, with | between
  double factor;
};

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTurnPerMinute = 2.0 * std::numbers::pi / 60.0;
constexpr double kPound_N = 0.45359237 * kStandardGravity_mps2;

constexpr UnitWords kTimes[] = {
    {"s", "sec|secs|second|seconds|sek|sekunden|epoch_s|epochs|unix", 1.0},
    {"ms", "msec|msecs|millisecond|milliseconds|epoch_ms|epochms", 1e-3},
    {"us", "µs|μs|usec|microsecond|microseconds|epoch_us|epochus", 1e-6},
    {"ns", "nsec|nanosecond|nanoseconds|epoch_ns|epochns", 1e-9},
    {"min", "minute|minutes", 60.0},
};
constexpr UnitWords kLengthWords[] = {
    {"m", "meter|meters|metre|metres", 1.0},
    {"mm", "millimeter|millimeters|millimetre|millimetres", 1e-3},
    {"cm", "centimeter|centimeters|centimetre|centimetres", 1e-2},
    {"um", "µm|μm|micron|microns|micrometer|micrometers|micrometre|micrometres", 1e-6},
    {"nm", "nanometer|nanometers|nanometre|nanometres", 1e-9},
    {"inch", "in|inches|\"", 0.0254},
    {"ft", "foot|feet", 0.3048},
};
constexpr UnitWords kAngles[] = {
    {"rad", "radian|radians", 1.0},
    {"deg", "°|degree|degrees", kDegree},
    {"mrad", "milliradian|milliradians", 1e-3},
};
constexpr UnitWords kRates[] = {
    {"rad/s", "radps|rads-1|rad/sec|radian/s|radians/s|radianspersecond", 1.0},
    {"deg/s", "dps|degps|°/s|deg/sec|degs-1|°s-1|degree/s|degrees/s|degreespersecond", kDegree},
    {"mdeg/s", "mdps|m°/s", 1e-3 * kDegree},
    {"rpm", "1/min|min-1", kTurnPerMinute},
};
constexpr UnitWords kAccelerations[] = {
    {"m/s2", "m/s/s|mps2|ms-2|m/sec2|meter/s2|meters/s2|metres/s2|m/(s2)", 1.0},
    {"mm/s2", "mmps2|mms-2", 1e-3},
    {"g", "g0|gn|gs|g-force|gee", kStandardGravity_mps2},
    {"mg", "milli-g|millig|mg0", 1e-3 * kStandardGravity_mps2},
    {"gal", "cm/s2|cms-2", 1e-2},
};
constexpr UnitWords kForces[] = {
    {"N", "newton|newtons", 1.0},
    {"mN", "millinewton|millinewtons", 1e-3},
    {"cN", "centinewton|centinewtons", 1e-2},
    {"kN", "kilonewton|kilonewtons", 1e3},
    {"gf", "g|gram-force|gramforce|grams|gram|pond|p", 1e-3 * kStandardGravity_mps2},
    {"kgf", "kg|kilogram-force|kp|kilopond", kStandardGravity_mps2},
    {"lbf", "lb|lbs|pound|pounds", kPound_N},
    {"ozf", "oz|ounce|ounces", kPound_N / 16.0},
};
constexpr UnitWords kNumbers[] = {{"1", "", 1.0}};

std::span<const UnitWords> units_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::kTime:
      return kTimes;
    case Quantity::kLength:
      return kLengthWords;
    case Quantity::kAngle:
      return kAngles;
    case Quantity::kRate:
      return kRates;
    case Quantity::kAcceleration:
      return kAccelerations;
    case Quantity::kForce:
      return kForces;
    case Quantity::kNumber:
      break;
  }
  return kNumbers;
}

std::string lower_letters(std::string_view text) {
  std::string out;
  for (const char c : text) out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

// Without blanks, ^, * and brackets; superscripts as digits.
std::string plain_unit(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    if (rest.starts_with("²")) {
      out += '2', i += std::string_view("²").size() - 1;
    } else if (rest.starts_with("⁻¹")) {
      out += "-1", i += std::string_view("⁻¹").size() - 1;
    } else if (rest.starts_with("⁻²")) {
      out += "-2", i += std::string_view("⁻²").size() - 1;
    } else if (rest.starts_with("·")) {
      i += std::string_view("·").size() - 1;
    } else if (text[i] != ' ' && text[i] != '^' && text[i] != '*' && text[i] != '[' && text[i] != ']') {
      out += text[i];
    }
  }
  return out;
}

template <class Same>
const UnitWords* find_words(std::span<const UnitWords> units, const Same& same) {
  for (const UnitWords& unit : units) {
    if (same(unit.name)) return &unit;
    std::string_view words = unit.words;
    while (!words.empty()) {
      const std::size_t end = std::min(words.find('|'), words.size());
      if (same(words.substr(0, end))) return &unit;
      words.remove_prefix(std::min(end + 1, words.size()));
    }
  }
  return nullptr;
}

const UnitWords* find_unit_words(std::string_view text, Quantity quantity) {
  const auto units = units_of(quantity);
  if (const auto* exact = find_words(units, [&](std::string_view word) { return word == text; })) return exact;
  const std::string lower = lower_letters(text);
  // "MN" and "MG" are not what a case apart would make of them.
  if (text == "MN" || text == "MG" || text == "MM" || text == "MS") return nullptr;
  return find_words(units, [&](std::string_view word) { return lower_letters(word) == lower; });
}

struct ScaledText {
  double scale = 1.0;
  std::string_view unit;
};

// "1/16384 g", "0.061mg": the number before the unit.
std::optional<ScaledText> split_scale(std::string_view text) {
  text = trim(text);
  const std::size_t end = std::min(text.find_first_not_of("0123456789.eE+-/"), text.size());
  std::string_view number = text.substr(0, end);
  // "1/min" and "1e-3" are no such numbers; the unit begins with a letter.
  while (!number.empty() && (number.back() == 'e' || number.back() == 'E' || number.back() == '/')) {
    number.remove_suffix(1);
  }
  if (number.empty()) return ScaledText{1.0, text};
  const auto slash = number.find('/');
  const auto above = parse_double(number.substr(0, slash));
  const auto below =
      slash == std::string_view::npos ? std::optional<double>(1.0) : parse_double(number.substr(slash + 1));
  if (!above || !below || *below == 0.0) return std::nullopt;
  const double scale = *above / *below;
  if (!std::isfinite(scale) || scale == 0.0) return std::nullopt;
  return ScaledText{scale, trim(text.substr(number.size()))};
}

}  // namespace

std::optional<ImportUnit> find_import_unit(std::string_view text, Quantity quantity) {
  const std::string plain = plain_unit(trim(text));
  if (quantity == Quantity::kTime && (lower_letters(plain) == "iso" || lower_letters(plain) == "date")) {
    return ImportUnit{"iso", 1.0, 0, true, false};
  }
  if (const UnitWords* unit = find_unit_words(plain, quantity); unit != nullptr && !plain.empty()) {
    const double ns = quantity == Quantity::kTime ? std::round(unit->factor * 1e9) : 0.0;
    return ImportUnit{std::string(unit->name), unit->factor, std::llround(ns), false, false};
  }
  if (quantity == Quantity::kNumber || quantity == Quantity::kTime) return std::nullopt;
  const auto scaled = split_scale(text);
  if (!scaled || scaled->scale == 1.0) return std::nullopt;
  const UnitWords* unit = find_unit_words(plain_unit(scaled->unit), quantity);
  if (unit == nullptr) return std::nullopt;
  return ImportUnit{std::string(trim(text)), scaled->scale * unit->factor, 0, false, true};
}

ImportUnit parse_import_unit(std::string_view text, Quantity quantity, std::string_view what) {
  if (auto unit = find_import_unit(text, quantity)) return *unit;
  const bool scales =
      quantity == Quantity::kAcceleration || quantity == Quantity::kRate || quantity == Quantity::kForce;
  const char* example = quantity == Quantity::kRate ? "deg/s" : quantity == Quantity::kForce ? "N" : "g";
  throw Error(
      fmt::format("{}: '{}' is not a known unit: {}{}", what, printable(text), import_unit_names(quantity),
                  scales ? fmt::format(", or counts by their scale, such as 1/16384 {}", example) : std::string()));
}

std::string import_unit_names(Quantity quantity) {
  std::string out;
  for (const UnitWords& unit : units_of(quantity)) {
    if (!out.empty()) out += ", ";
    out += unit.name;
  }
  if (quantity == Quantity::kTime) out += ", iso";
  return out;
}

bool is_unit(std::string_view text) {
  const std::string plain = plain_unit(trim(text));
  if (plain.empty()) return false;
  for (const Quantity quantity : {Quantity::kTime, Quantity::kLength, Quantity::kAngle, Quantity::kRate,
                                  Quantity::kAcceleration, Quantity::kForce}) {
    if (find_words(units_of(quantity), [&](std::string_view word) { return word == plain; }) != nullptr) return true;
  }
  return false;
}

}  // namespace asperity
