#include "roughness_tables.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "asperity/base/interval_text.h"

namespace asperity::app {

namespace {

// Name and factor of the unit that a quantity is shown in, and the ending of its key.
struct ShownUnit {
  const char* name;
  double factor;
  const char* ending;
};

ShownUnit shown(ProfileQuantity quantity) {
  switch (quantity) {
    case ProfileQuantity::kHeight:
    case ProfileQuantity::kAlong:
      return {"µm", 1e6, "_m"};
    case ProfileQuantity::kRatio:
      return {"%", 100.0, ""};
    case ProfileQuantity::kPerLength:
      return {"1/cm", 1e-2, "_per_m"};
    case ProfileQuantity::kCurvature:
      return {"1/mm", 1e-3, "_per_m"};
    default:
      return {"", 1.0, ""};
  }
}

ShownUnit shown(ArealQuantity quantity) {
  switch (quantity) {
    case ArealQuantity::kHeight:
    case ArealQuantity::kAlong:
      return {"µm", 1e6, ""};
    case ArealQuantity::kRatio:
      return {"%", 100.0, ""};
    case ArealQuantity::kAngle:
      return {"°", 180.0 / std::numbers::pi, ""};
    default:
      return {"", 1.0, ""};
  }
}

std::string value_text(double value, double error, const ShownUnit& unit) {
  return interval_text(unit.factor * value, unit.factor * error);
}

// The same with the value's end in one column.
std::string aligned_interval(double value, double error) {
  const IntervalText text = interval_parts(value, error);
  return fmt::format("{:>12}{}{}", text.value, text.error.empty() ? "" : " ± ", text.error);
}

std::string padded(const std::string& text, std::size_t width) {
  std::size_t columns = 0;
  for (const char c : text) columns += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
  return text + std::string(columns < width ? width - columns : 1, ' ');
}

// The profiles that there are, by their letters.
std::vector<std::pair<char, const ProfileParametersResult*>> listed(const ProfileTexture& texture) {
  std::vector<std::pair<char, const ProfileParametersResult*>> out{{'P', &texture.P}};
  if (texture.R) out.emplace_back('R', &*texture.R);
  if (texture.W) out.emplace_back('W', &*texture.W);
  return out;
}

}  // namespace

Json to_json(const std::vector<PrintedParameter>& parameters) {
  Json out;
  for (const auto& [key, value, length, error] : parameters) {
    out[key] = value;
    if (!std::isfinite(error)) continue;
    const std::string name = key.substr(0, key.size() - (length ? 2 : 0));
    out[name + (length ? "_stderr_m" : "_stderr")] = error;
  }
  return out;
}

std::string to_table(const std::vector<PrintedParameter>& parameters) {
  std::string out;
  for (const auto& [key, value, length, error] : parameters) {
    const std::string name = key.substr(0, key.size() - (length ? 2 : 0));
    const double unit = length ? 1e6 : 1.0;
    out += fmt::format("{:<6} ", name);
    out += aligned_interval(unit * value, unit * error);
    out += length && std::isfinite(unit * value) ? " µm\n" : "\n";
  }
  return out;
}

Json to_json(const ProfileTexture& texture) {
  Json out;
  for (const auto& [letter, result] : listed(texture)) {
    Json one;
    one["length_m"] = result->length_m;
    one["sections_used"] = result->sections_used;
    one["elements"] = result->elements;
    for (const ProfileParameter& p : kProfileParameters) {
      const std::string name = letter + std::string(p.suffix);
      const std::string ending = shown(p.quantity).ending;
      one[name + ending] = result->*p.value;
      const double error = result->standard_error.*p.value;
      if (std::isfinite(error)) one[name + "_stderr" + ending] = error;
    }
    out[std::string(1, letter)] = one;
  }
  return out;
}

std::string to_table(const ProfileTexture& texture) {
  constexpr std::size_t kName = 7, kValue = 24;
  std::string out = "ISO 21920-2";
  out += !texture.R  ? "; without λc all of the profile is P\n"
         : texture.W ? "\n"
                     : "; the profile is too short for W\n";
  for (const ProfileParameter& p : kProfileParameters) {
    const ShownUnit unit = shown(p.quantity);
    for (const auto& [letter, result] : listed(texture)) {
      out += padded(letter + std::string(p.suffix), kName) +
             padded(value_text(result->*p.value, result->standard_error.*p.value, unit), kValue);
    }
    out += std::string(unit.name) + "\n";
  }
  return out;
}

Json to_json(const ArealTextureResult& result) {
  Json out;
  for (const ArealParameter& p : kArealParameters) {
    const std::string key(p.key);
    out[key] = result.*p.value;
    const double error = result.standard_error.*p.value;
    if (std::isfinite(error)) out[std::string(p.name) + "_stderr" + key.substr(p.name.size())] = error;
  }
  return out;
}

std::string to_table(const ArealTextureResult& result) {
  std::string out;
  for (const ArealParameter& p : kArealParameters) {
    const ShownUnit unit = shown(p.quantity);
    const double value = result.*p.value, error = result.standard_error.*p.value;
    out += fmt::format("{:<6} ", p.name);
    out += aligned_interval(unit.factor * value, unit.factor * error);
    if (std::isfinite(value)) out += std::string(" ") + unit.name;
    while (out.back() == ' ') out.pop_back();
    out += "\n";
  }
  return out;
}

}  // namespace asperity::app
