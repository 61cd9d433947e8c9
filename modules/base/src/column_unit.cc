#include "asperity/base/column_unit.h"

#include <algorithm>
#include <array>
#include <string>

#include "asperity/base/text.h"

namespace asperity {
namespace {

struct LengthWords {
  double metres;
  std::string_view words;  // in small letters, with '|' between
};

constexpr double kInch_m = 0.0254;
constexpr std::array<LengthWords, 12> kLengths{{
    {1e-10, "å|ångström|ångströms|angstrom|angstroms|angstroem|ang"},
    {1e-12, "pm|picometer|picometre"},
    {1e-9, "nm|nanometer|nanometers|nanometre|nanometres"},
    {1e-6, "um|µm|micron|microns|mic|micrometer|micrometers|micrometre|micrometres|mikrometer"},
    {1e-3, "mm|millimeter|millimeters|millimetre|millimetres"},
    {1e-2, "cm|centimeter|centimeters|centimetre|centimetres"},
    {1e-1, "dm|decimeter|decimetre"},
    {1.0, "m|meter|meters|metre|metres"},
    {1e-6 * kInch_m, "uin|µin|microinch|microinches|µinch|uinch"},
    {1e-3 * kInch_m, "mil|mils|thou"},
    {kInch_m, "in|inch|inches"},
    {0.3048, "ft|foot|feet"},
}};

// Units of other quantities that end a name without brackets.
constexpr std::string_view kOthers =
    "mv|uv|µv|kv|volt|volts|mn|kn|newton|newtons|nm|deg|degree|degrees|°|rad|mrad|sec|ms|us|µs|ns|hz|khz|mhz|mg|kg|pa|"
    "kpa|mpa|gpa|db|%|percent|counts|count|digits|lsb|px|pixel|pixels|ma|ua|µa|ohm|°c";
// Letters of which others of the same case are names.
constexpr std::string_view kOtherLetters = "V|N|g|s";

// Small letters, and one of each of the characters that look alike.
std::string folded(std::string_view text) {
  struct Alike {
    std::string_view from, to;
  };
  static constexpr std::array<Alike, 6> kAlike{{{"\xce\xbc", "µ"},      // the Greek letter
                                                {"\xce\x9c", "µ"},      // its capital, as of "µm" in capitals
                                                {"\xc3\x85", "å"},      // Å
                                                {"\xe2\x84\xab", "å"},  // the ångström sign
                                                {"A\xcc\x8a", "å"},     // A and a ring
                                                {"\xc3\x96", "ö"}}};
  std::string out;
  while (!text.empty()) {
    const auto alike =
        std::find_if(kAlike.begin(), kAlike.end(), [&](const Alike& one) { return text.starts_with(one.from); });
    if (alike != kAlike.end()) {
      out += alike->to;
      text.remove_prefix(alike->from.size());
      continue;
    }
    const char c = text.front();
    if (c == '\xb5') {  // µ in Latin-1; its continuation in UTF-8 is taken with the byte before
      out += "µ";
    } else if (text.starts_with("µ")) {
      out += "µ";
      text.remove_prefix(1);
    } else {
      out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    text.remove_prefix(1);
  }
  return out;
}

bool has_word(std::string_view words, std::string_view word) {
  if (word.empty()) return false;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find('|'), words.size());
    if (words.substr(0, end) == word) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

bool is_newton_metre(std::string_view unit) { return unit == "Nm"; }

std::string_view without_quotes(std::string_view text) {
  text = trim(text);
  while (text.size() > 1 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front())
    text = trim(text.substr(1, text.size() - 2));
  return text;
}

// What is in the last pair of brackets, or in the last that has a length.
std::optional<ColumnUnit> in_brackets(std::string_view name) {
  std::optional<ColumnUnit> found;
  for (std::size_t open = name.find_first_of("[("); open != std::string_view::npos;
       open = name.find_first_of("[(", open + 1)) {
    const std::size_t close = name.find(name[open] == '[' ? ']' : ')', open);
    if (close == std::string_view::npos) break;
    const std::string_view unit = trim(name.substr(open + 1, close - open - 1));
    if (unit.empty() || (found && found->unit_m && !length_of_unit_m(unit))) continue;
    std::string_view quantity = trim(name.substr(0, open));
    while (quantity.ends_with('_')) quantity.remove_suffix(1);
    found = ColumnUnit{quantity, unit, length_of_unit_m(unit)};
  }
  return found;
}

}  // namespace

std::optional<double> length_of_unit_m(std::string_view unit) {
  if (is_newton_metre(unit)) return std::nullopt;
  const std::string word = folded(unit);
  for (const LengthWords& length : kLengths) {
    if (has_word(length.words, word)) return length.metres;
  }
  return std::nullopt;
}

ColumnUnit column_unit(std::string_view name) {
  name = without_quotes(name);
  if (const auto found = in_brackets(name)) return *found;
  const std::size_t end = name.find_last_of("_ \t/,");
  if (end == std::string_view::npos) return {name, {}, std::nullopt};
  const std::string_view unit = name.substr(end + 1);
  const ColumnUnit found{trim(name.substr(0, end)), unit, length_of_unit_m(unit)};
  if (found.unit_m || has_word(kOthers, folded(unit)) || has_word(kOtherLetters, unit)) return found;
  return {name, {}, std::nullopt};
}

}  // namespace asperity
