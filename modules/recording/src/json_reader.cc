#include "json_reader.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "utf8_check.h"

namespace asperity {

using nlohmann::json;

namespace {

std::string place_in_text(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const auto start = before.rfind('\n');
  const std::size_t column = start == std::string_view::npos ? before.size() : before.size() - start - 1;
  return fmt::format("{}:{}", line + 1, std::max<std::size_t>(column, 1));
}

// The reason in nlohmann's "[json.exception…] parse error at line 1, column 2: syntax error … - reason".
std::string reason_of(const json::exception& error) {
  std::string_view what = error.what();
  for (const std::string_view mark :
       {std::string_view("] "), std::string_view("parse error at "), std::string_view(": ")}) {
    const auto at = what.find(mark);
    if (at != std::string_view::npos) what.remove_prefix(at + mark.size());
  }
  return printable(what, 200);
}

std::string shown(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array";
  return printable(value.dump());
}

}  // namespace

json parse_json(std::string_view text, const std::string& name, const ReadLimits& limits) {
  require_utf8(text, name);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<std::set<std::string>> open;
  std::int64_t values = 0;
  const auto watch = [&](int depth, json::parse_event_t event, json& parsed) {
    if (depth >= limits.json_depth) throw Error(fmt::format("{}: nested more than {} deep", name, limits.json_depth));
    if (++values > limits.json_values) throw Error(fmt::format("{}: more than {} values", name, limits.json_values));
    if (event == json::parse_event_t::object_start) open.emplace_back();
    if (event == json::parse_event_t::object_end) open.pop_back();
    if (event == json::parse_event_t::key && !open.back().insert(parsed.get<std::string>()).second) {
      throw Error(fmt::format("{}: key '{}' appears twice", name, printable(parsed.get<std::string>())));
    }
    return true;
  };
  try {
    return json::parse(text.begin(), text.end(), watch);
  } catch (const json::parse_error& error) {
    throw Error(fmt::format("{}:{}: not JSON: {}", name, place_in_text(text, error.byte), reason_of(error)));
  } catch (const json::exception& error) {
    throw Error(fmt::format("{}: not usable JSON: {}", name, reason_of(error)));
  }
}

JsonObject::JsonObject(const json& value, std::string name, std::string path)
    : value_(&value), name_(std::move(name)), path_(std::move(path)) {
  if (value.is_object()) return;
  if (path_.empty()) throw Error(name_ + ": must be a JSON object, found " + shown(value));
  throw Error(fmt::format("{}: key '{}': must be an object, found {}", name_, path_, shown(value)));
}

std::string JsonObject::place(const std::string& key) const {
  return printable(path_.empty() ? key : path_ + "." + key, 200);
}

void JsonObject::fail(const std::string& key, const std::string& message) const {
  throw Error(fmt::format("{}: key '{}': {}", name_, place(key), message));
}

const json* JsonObject::find(const std::string& key) {
  known_.insert(key);
  const auto found = value_->find(key);
  return found == value_->end() ? nullptr : &*found;
}

const json& JsonObject::require(const std::string& key) {
  const json* value = find(key);
  if (value == nullptr) fail(key, "is missing");
  return *value;
}

std::optional<JsonObject> JsonObject::object(const std::string& key) {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return JsonObject(*value, name_, path_.empty() ? key : path_ + "." + key);
}

JsonObject JsonObject::required_object(const std::string& key) {
  require(key);
  return *object(key);
}

double JsonObject::number_of(const json& value, const std::string& key, Range range) const {
  if (!value.is_number()) fail(key, "must be a number, found " + shown(value));
  const double number = value.get<double>();
  if (!std::isfinite(number) || number < range.low || number > range.high) {
    fail(key, fmt::format("{} is outside {} to {}", shown(value), range.low, range.high));
  }
  return number;
}

void JsonObject::read_number(const std::string& key, double& out, Range range) {
  if (const json* value = find(key)) out = number_of(*value, key, range);
}

void JsonObject::read_integer(const std::string& key, std::int64_t& out, std::int64_t low, std::int64_t high) {
  const json* value = find(key);
  if (value == nullptr) return;
  if (!value->is_number_integer()) fail(key, "must be a whole number, found " + shown(*value));
  const bool too_large =
      value->is_number_unsigned() && value->get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX);
  if (too_large || value->get<std::int64_t>() < low || value->get<std::int64_t>() > high) {
    fail(key, fmt::format("{} is outside {} to {}", shown(*value), low, high));
  }
  out = value->get<std::int64_t>();
}

void JsonObject::read_text(const std::string& key, std::string& out) {
  const json* value = find(key);
  if (value == nullptr) return;
  if (!value->is_string()) fail(key, "must be a text, found " + shown(*value));
  out = value->get<std::string>();
  if (out.size() > 10'000) fail(key, fmt::format("a text of {} bytes, more than 10000", out.size()));
}

void JsonObject::read_bool(const std::string& key, bool& out) {
  const json* value = find(key);
  if (value == nullptr) return;
  if (!value->is_boolean()) fail(key, "must be true or false, found " + shown(*value));
  out = value->get<bool>();
}

void JsonObject::read_numbers(const std::string& key, double* out, std::size_t count, Range range) {
  const json* value = find(key);
  if (value == nullptr) return;
  if (!value->is_array() || value->size() != count) {
    fail(key, fmt::format("must be an array of {} numbers, found {}", count,
                          value->is_array() ? fmt::format("{} values", value->size()) : shown(*value)));
  }
  for (std::size_t i = 0; i < count; ++i) out[i] = number_of((*value)[i], fmt::format("{}[{}]", key, i), range);
}

void JsonObject::read_vector(const std::string& key, Eigen::Vector3d& out, Range range) {
  read_numbers(key, out.data(), 3, range);
}

void JsonObject::read_matrix(const std::string& key, Eigen::Matrix<double, 3, Eigen::Dynamic>& out,
                             const std::set<int>& columns) {
  const json* value = find(key);
  if (value == nullptr) return;
  if (!value->is_array() || value->size() != 3) fail(key, "must be an array of 3 rows");
  const std::size_t width = (*value)[0].is_array() ? (*value)[0].size() : 0;
  if (width > 1000 || columns.count(static_cast<int>(width)) == 0) {
    fail(key, fmt::format("its first row has {} numbers; allowed: {}", width,
                          fmt::format("{}", *columns.begin()) +
                              (columns.size() > 1 ? fmt::format(" or {}", *columns.rbegin()) : "")));
  }
  out.resize(3, static_cast<Eigen::Index>(width));
  for (std::size_t row = 0; row < 3; ++row) {
    const json& cells = (*value)[row];
    if (!cells.is_array() || cells.size() != width)
      fail(key, fmt::format("row {} must have {} numbers", row + 1, width));
    for (std::size_t i = 0; i < width; ++i) {
      out(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)) =
          number_of(cells[i], fmt::format("{}[{}][{}]", key, row, i), {});
    }
  }
}

json JsonObject::read_extra() {
  const json* value = find("extra");
  if (value == nullptr) return json::object();
  if (!value->is_object()) fail("extra", "must be an object, found " + shown(*value));
  return *value;
}

void JsonObject::require_format(std::string_view format) {
  const json& value = require("format");
  if (!value.is_string() || value.get<std::string>() != format) {
    fail("format", fmt::format("must be \"{}\", found {}", format, shown(value)));
  }
  const json& version = require("version");
  if (!version.is_number_integer() || version != 1) {
    fail("version", "must be 1, the version that this program reads; found " + shown(version));
  }
}

void JsonObject::finish() const {
  for (const auto& item : value_->items()) {
    if (known_.count(item.key()) == 0) fail(item.key(), "is not known here; what others add belongs in 'extra'");
  }
}

}  // namespace asperity
