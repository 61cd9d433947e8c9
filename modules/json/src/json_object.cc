#include "asperity/json/json_object.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

[[noreturn]] void fail_at(const std::string& file, JsonPlace place, std::string_view path, std::string_view message) {
  const std::string where = place.line == 0 ? file : fmt::format("{}:{}:{}", file, place.line, place.column);
  if (path.empty()) throw Error(fmt::format("{}: {}", where, message));
  throw Error(fmt::format("{}: key '{}': {}", where, printable(path, 200), message));
}

}  // namespace

JsonItem::JsonItem(const Json& value, const std::string& file, std::string path)
    : value_(&value), file_(&file), path_(std::move(path)) {}

void JsonItem::fail(const std::string& message) const { fail_at(*file_, value_->place(), path_, message); }

double JsonItem::number_of(const Json& value, Range range, std::ptrdiff_t element) const {
  const auto refuse = [&](const std::string& message) {
    fail_at(*file_, value.place(), element < 0 ? path_ : fmt::format("{}[{}]", path_, element), message);
  };
  if (!value.is_number()) refuse("must be a number, found " + shown(value));
  const auto number = value.get<double>();
  if (!std::isfinite(number) || number < range.low || number > range.high) {
    refuse(fmt::format("{} is outside {} to {}", shown(value), range.low, range.high));
  }
  return number;
}

double JsonItem::number(Range range) const { return number_of(*value_, range, -1); }

std::int64_t JsonItem::integer(std::int64_t low, std::int64_t high) const {
  if (!value_->is_number_integer()) fail("must be a whole number, found " + shown(*value_));
  const bool too_large = value_->is_number_unsigned() && value_->get<std::uint64_t>() > std::uint64_t{INT64_MAX};
  if (too_large || value_->get<std::int64_t>() < low || value_->get<std::int64_t>() > high) {
    fail(fmt::format("{} is outside {} to {}", shown(*value_), low, high));
  }
  return value_->get<std::int64_t>();
}

bool JsonItem::boolean() const {
  if (!value_->is_boolean()) fail("must be true or false, found " + shown(*value_));
  return value_->get<bool>();
}

const std::string& JsonItem::text(std::size_t longest_bytes) const {
  if (!value_->is_string()) fail("must be a text, found " + shown(*value_));
  if (value_->text().size() > longest_bytes) {
    fail(fmt::format("a text of {} bytes, more than {}", value_->text().size(), longest_bytes));
  }
  return value_->text();
}

std::size_t JsonItem::choice(std::span<const std::string_view> names) const {
  const auto found = std::find(names.begin(), names.end(), text());
  if (found == names.end()) {
    std::string all;
    for (const auto one : names) all.append(all.empty() ? "" : ", ").append(one);
    fail(fmt::format("'{}' is not one of {}", printable(text()), all));
  }
  return static_cast<std::size_t>(found - names.begin());
}

std::vector<double> JsonItem::numbers(std::size_t most, Range range) const {
  if (!value_->is_array()) fail("must be an array of numbers, found " + shown(*value_));
  std::vector<double> out(list(most));
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = number_of(value_->at(i), range, static_cast<std::ptrdiff_t>(i));
  }
  return out;
}

void JsonItem::numbers(double* out, std::size_t count, Range range) const {
  if (!value_->is_array() || value_->size() != count) {
    fail(fmt::format("must be an array of {} numbers, found {}", count,
                     value_->is_array() ? fmt::format("{} values", value_->size()) : shown(*value_)));
  }
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = number_of(value_->at(i), range, static_cast<std::ptrdiff_t>(i));
  }
}

std::size_t JsonItem::list(std::size_t most) const {
  if (!value_->is_array()) fail("must be an array, found " + shown(*value_));
  if (value_->size() > most) fail(fmt::format("has {} entries, more than {}", value_->size(), most));
  return value_->size();
}

JsonItem JsonItem::element(std::size_t i) const { return {value_->at(i), *file_, fmt::format("{}[{}]", path_, i)}; }

std::vector<JsonItem> JsonItem::elements(std::size_t most) const {
  std::vector<JsonItem> out;
  out.reserve(list(most));
  for (std::size_t i = 0; i < value_->size(); ++i) out.push_back(element(i));
  return out;
}

JsonObject::JsonObject(JsonItem item) : item_(std::move(item)) {
  if (item_.json().is_object()) return;
  item_.fail(std::string(item_.path().empty() ? "must be a JSON object" : "must be an object") + ", found " +
             shown(item_.json()));
}

std::string JsonObject::path_of(std::string_view key) const {
  return item_.path().empty() ? std::string(key) : fmt::format("{}.{}", item_.path(), key);
}

void JsonObject::fail(std::string_view key, const std::string& message) const {
  const Json* value = item_.json().find(key);
  fail_at(item_.file(), (value == nullptr ? item_.json() : *value).place(), path_of(key), message);
}

const Json* JsonObject::find(std::string_view key) {
  if (known_.find(key) == known_.end()) known_.emplace(key);
  return item_.json().find(key);
}

std::optional<JsonItem> JsonObject::optional(std::string_view key) {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return JsonItem(*value, item_.file(), path_of(key));
}

JsonItem JsonObject::required(std::string_view key) {
  auto value = optional(key);
  if (!value) fail(key, "is missing");
  return *std::move(value);
}

std::optional<JsonObject> JsonObject::optional_object(std::string_view key) {
  auto value = optional(key);
  if (!value) return std::nullopt;
  return JsonObject(*std::move(value));
}

JsonObject JsonObject::required_object(std::string_view key) { return JsonObject(required(key)); }

void JsonObject::read_number(std::string_view key, double& out, Range range) {
  if (const auto value = optional(key)) out = value->number(range);
}
void JsonObject::read_integer(std::string_view key, std::int64_t& out, std::int64_t low, std::int64_t high) {
  if (const auto value = optional(key)) out = value->integer(low, high);
}
void JsonObject::read_text(std::string_view key, std::string& out, std::size_t longest_bytes) {
  if (const auto value = optional(key)) out = value->text(longest_bytes);
}
void JsonObject::read_bool(std::string_view key, bool& out) {
  if (const auto value = optional(key)) out = value->boolean();
}
void JsonObject::read_numbers(std::string_view key, double* out, std::size_t count, Range range) {
  if (const auto value = optional(key)) value->numbers(out, count, range);
}

Json JsonObject::extra() {
  const auto value = optional("extra");
  if (!value) return Json::object();
  if (!value->json().is_object()) value->fail("must be an object, found " + shown(value->json()));
  return value->json();
}

void JsonObject::require_format(std::string_view format) {
  const JsonItem found = required("format");
  if (found.json() != Json(format)) {
    found.fail(fmt::format("must be \"{}\", found {}", format, shown(found.json())));
  }
  const JsonItem version = required("version");
  if (!version.json().is_number_integer() || version.json() != Json(1)) {
    version.fail("must be 1, the version that this program reads; found " + shown(version.json()));
  }
}

void JsonObject::finish() const {
  for (const auto& [key, value] : item_.json().items()) {
    if (known_.find(key) == known_.end()) {
      fail(key, "is not known here; what others add belongs in 'extra'");
    }
  }
}

}  // namespace asperity
