#include "block_json.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

using Json = LocatedJson::Json;

constexpr std::size_t kLongestText_bytes = 4096;

std::string joined(const std::string& path, const char* key) { return path.empty() ? key : path + "." + key; }

}  // namespace

double read_number(const LocatedJson& json, const Json& value, const std::string& path, double low, double high) {
  if (!value.is_number()) json.fail(path, "is not a number");
  const double result = value.get<double>();
  if (!std::isfinite(result) || result < low || result > high) {
    json.fail(path, number_text(result) + " is not within " + number_text(low) + " and " + number_text(high));
  }
  return result;
}

std::string read_text(const LocatedJson& json, const Json& value, const std::string& path) {
  if (!value.is_string()) json.fail(path, "is not a text");
  const std::string& result = value.text();
  if (result.size() > kLongestText_bytes)
    json.fail(path, "is longer than " + std::to_string(kLongestText_bytes) + " bytes");
  return result;
}

std::vector<double> read_numbers(const LocatedJson& json, const Json& value, const std::string& path, double largest,
                                 std::size_t most) {
  if (!value.is_array()) json.fail(path, "is not a list of numbers");
  if (value.size() > most)
    json.fail(path, std::to_string(value.size()) + " numbers, more than " + std::to_string(most));
  std::vector<double> result;
  result.reserve(value.size());
  for (const Json& element : value) {
    result.push_back(read_number(json, element, path + "[" + std::to_string(result.size()) + "]", -largest, largest));
  }
  return result;
}

double required_number(const LocatedJson& json, const std::string& path, const char* key, double low, double high) {
  return read_number(json, json.require(path, key), joined(path, key), low, high);
}

std::int64_t required_integer(const LocatedJson& json, const std::string& path, const char* key, std::int64_t low,
                              std::int64_t high) {
  const Json& value = json.require(path, key);
  if (!value.is_number_integer()) json.fail(joined(path, key), "is not a whole number");
  const bool too_large = value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(high);
  if (too_large || value.get<std::int64_t>() < low || value.get<std::int64_t>() > high) {
    json.fail(joined(path, key),
              value.dump() + " is not within " + std::to_string(low) + " and " + std::to_string(high));
  }
  return value.get<std::int64_t>();
}

std::string required_text(const LocatedJson& json, const std::string& path, const char* key) {
  return read_text(json, json.require(path, key), joined(path, key));
}

std::vector<double> required_numbers(const LocatedJson& json, const std::string& path, const char* key, double largest,
                                     std::size_t most) {
  return read_numbers(json, json.require(path, key), joined(path, key), largest, most);
}

std::size_t required_choice(const LocatedJson& json, const std::string& path, const char* key,
                            const std::vector<std::string_view>& names) {
  const std::string name = required_text(json, path, key);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    std::string all;
    for (const auto one : names) all.append(all.empty() ? "" : ", ").append(one);
    json.fail(joined(path, key), "'" + printable(name) + "' is not one of " + all);
  }
  return static_cast<std::size_t>(found - names.begin());
}

double optional_number(const LocatedJson& json, const std::string& path, const char* key, double low, double high,
                       double fallback) {
  const Json* value = json.find(path, key);
  return value ? read_number(json, *value, joined(path, key), low, high) : fallback;
}

std::string number_json(double value, const char* key) {
  if (!std::isfinite(value))
    throw Error(std::string("texture: '") + key + "' is " + number_text(value) + ", which a file cannot hold");
  return number_text(value);
}

std::string text_json(const std::string& value, const char* key) {
  if (!is_utf8(value)) throw Error(std::string("texture: '") + key + "' is not UTF-8 text: " + printable(value));
  return Json(value).dump();
}

std::string numbers_json(const std::vector<double>& values, const char* key) {
  std::string out = "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) out += ", ";
    out += number_json(values[i], key);
  }
  return out + "]";
}

}  // namespace asperity
