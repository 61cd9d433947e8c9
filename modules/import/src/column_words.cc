#include "column_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace asperity {

namespace {

using Tokens = std::vector<std::string>;

constexpr std::array kQuantities{Quantity::kTime, Quantity::kLength,       Quantity::kAngle,
                                 Quantity::kRate, Quantity::kAcceleration, Quantity::kForce};

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_force_word(const std::string& word) {
  return is_one_of(word, {"f", "force", "kraft", "fn", "load", "loadcell", "newton", "newtons", "normalforce",
                          "normalkraft", "kraftsensor"});
}

// The letter that meanings of this kind begin with, by a word; 0: none.
char kind_of_word(const std::string& word) {
  if (is_one_of(word, {"q", "quat", "quaternion", "orientation"})) return 'q';
  if (is_one_of(word, {"r", "rotation", "rot"})) return 'r';
  if (is_one_of(word, {"p", "pos", "position", "t", "trans", "translation", "location"})) return 'p';
  if (is_one_of(word, {"a", "acc", "accel", "acceleration", "accelerometer", "totalacceleration", "beschleunigung"})) {
    return 'a';
  }
  if (is_one_of(word, {"g", "gyr", "gyro", "gyroscope", "w", "omega", "angular", "rate", "drehrate"})) return 'g';
  return is_force_word(word) ? 'f' : 0;
}

// "normal force", "load cell": of a force along the tip. A grip's or a friction's is another.
bool is_force_name(const Tokens& tokens) {
  const auto is_known = [](const std::string& word) {
    return is_force_word(word) ||
           is_one_of(word, {"normal", "contact", "applied", "total", "sensor", "cell", "measured", "value", "tip",
                            "axial", "vertical", "norm", "magnitude", "resultant", "probe"});
  };
  return std::any_of(tokens.begin(), tokens.end(), is_force_word) &&
         std::all_of(tokens.begin(), tokens.end(), is_known);
}

// Velocities, biases, covariances and the like are none of ours.
bool is_other_quantity(const Tokens& tokens) {
  bool angular = false, other = false;
  for (const std::string& token : tokens) {
    angular = angular || token == "angular";
    other = other ||
            is_one_of(token, {"v", "vel", "velocity", "b", "bias", "cov", "covariance", "std", "sigma", "error", "mag",
                              "magnetic", "magnetometer", "grip", "absolute", "moment", "torque", "gravity"});
  }
  return other && !angular;
}

bool is_axis(char c) { return c == 'x' || c == 'y' || c == 'z' || c == 'w'; }

bool is_any_unit(const std::string& text) {
  return std::any_of(kQuantities.begin(), kQuantities.end(),
                     [&](Quantity quantity) { return find_import_unit(text, quantity).has_value(); });
}

Quantity quantity_of_kind(char kind) { return quantity_of(kind == 'f' ? "f" : std::string(1, kind) + "x"); }

// As the header states it, or else the name; "" if neither does.
std::string unit_of_column(const DelimitedColumn& column) {
  if (!column.unit.empty()) return is_unit(column.unit) ? column.unit : std::string();
  const auto split = split_unit_of_name(column.name);
  return split ? split->unit : std::string();
}

}  // namespace

std::vector<std::string> split_name_words(std::string_view name) {
  std::vector<std::string> out;
  std::string token;
  const auto end_token = [&] {
    if (!token.empty()) out.push_back(std::move(token));
    token.clear();
  };
  bool was_lower = false;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) == 0 && byte < 0x80) {
      end_token();
      was_lower = false;
      continue;
    }
    if (was_lower && std::isupper(byte) != 0) end_token();
    was_lower = std::islower(byte) != 0;
    token += static_cast<char>(std::tolower(byte));
  }
  end_token();
  return out;
}

std::optional<NameWithUnit> split_unit_of_name(const std::string& name) {
  constexpr const char* kMarks = "_ ";
  const auto last = name.find_last_of(kMarks);
  if (last == std::string::npos || last == 0 || last + 1 == name.size()) return std::nullopt;
  const auto before = name.find_last_of(kMarks, last - 1);
  if (before != std::string::npos && before > 0) {
    std::string unit = name.substr(before + 1);
    unit[last - before - 1] = '/';
    if (is_any_unit(unit)) return NameWithUnit{name.substr(0, before), unit};
  }
  const std::string unit = name.substr(last + 1);
  return is_any_unit(unit) ? std::optional(NameWithUnit{name.substr(0, last), unit}) : std::nullopt;
}

bool has_other_unit(const DelimitedColumn& column, char kind) {
  if (kind == 0) return false;
  const std::string unit = unit_of_column(column);
  if (unit.empty()) return false;
  const Quantity quantity = quantity_of_kind(kind);
  return quantity != Quantity::kNumber && !find_import_unit(unit, quantity);
}

char kind_of_unit(const DelimitedColumn& column) {
  const std::string unit = unit_of_column(column);
  char out = 0;
  for (const char kind : {'p', 'g', 'a', 'f'}) {
    if (unit.empty() || !find_import_unit(unit, quantity_of_kind(kind))) continue;
    if (out != 0) return 0;
    out = kind;
  }
  return out;
}

std::optional<ColumnWords> words_of_column(const DelimitedColumn& column) {
  const auto split = split_unit_of_name(column.name);
  Tokens tokens = split_name_words(split ? split->name : column.name);
  const Tokens above = split_name_words(column.group);
  if (tokens.empty() || is_other_quantity(tokens) || is_other_quantity(above)) return std::nullopt;
  // A unit at the end of the name ("pxMm", "gx.deg.s") is not part of it.
  while (tokens.size() > 1 && !is_axis(tokens.back().back()) && (is_any_unit(tokens.back()) || tokens.back() == "s")) {
    tokens.pop_back();
  }
  std::string last = tokens.back();
  if (is_one_of(last, {"roll", "pitch", "yaw"}))
    return ColumnWords{'r', last == "roll" ? 'x' : last == "pitch" ? 'y' : 'z'};
  if (is_one_of(last, {"qi", "qj", "qk", "qr"})) return ColumnWords{'q', last[1] == 'r' ? 'w' : "xyz"[last[1] - 'i']};
  if (is_one_of(last, {"q0", "q1", "q2", "q3"})) return ColumnWords{'q', "wxyz"[last[1] - '0']};
  if (is_force_name(tokens)) return ColumnWords{'f', 0};
  if (last.empty() || !is_axis(last.back())) return std::nullopt;
  ColumnWords out{0, last.back()};
  last.pop_back();
  if (!last.empty()) {
    out.kind = kind_of_word(last);
    return out.kind == 0 ? std::nullopt : std::optional(out);
  }
  tokens.pop_back();
  for (const std::string& word : tokens) {
    if (out.kind == 0 || is_one_of(word, {"rate", "angular"})) {  // "rotation rate", "angular velocity"
      const char kind = kind_of_word(word);
      out.kind = kind != 0 ? kind : out.kind;
    }
  }
  // Of the rows above the lowest says most: "Rigid Body, probe, Rotation".
  for (auto word = above.rbegin(); word != above.rend() && out.kind == 0; ++word) out.kind = kind_of_word(*word);
  return out;
}

}  // namespace asperity
