#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/json/json.h"

namespace asperity {

class JsonObject;

// A value and its position, for reading it with messages that name the file, line, column, path and value:
//   scene.json:12:15: key 'textures[3].file': must be a text, found 7
class JsonItem {
 public:
  // `value` and `file`, what messages call its file, must outlive this. `path` is "" for the whole document.
  JsonItem(const Json& value, const std::string& file, std::string path = {});
  JsonItem(const Json& value, std::string&& file, std::string path = {}) = delete;

  const Json& json() const { return *value_; }
  const std::string& file() const { return *file_; }
  const std::string& path() const { return path_; }

  // Each throws Error for a value of another kind or out of range.
  double number(Range range = {}) const;
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  bool boolean() const;
  const std::string& text(std::size_t longest_bytes = 10'000) const;
  // The place of a text among `names`.
  std::size_t choice(std::span<const std::string_view> names) const;
  std::vector<double> numbers(std::size_t most, Range range = {}) const;
  void numbers(double* out, std::size_t count, Range range = {}) const;  // exactly `count`
  // The number of elements of a list of at most `most`, and one of them.
  std::size_t list(std::size_t most) const;
  JsonItem element(std::size_t i) const;
  // The items of a list, one after the other.
  std::vector<JsonItem> elements(std::size_t most) const;

  [[noreturn]] void fail(const std::string& message) const;

 private:
  double number_of(const Json& value, Range range, std::ptrdiff_t element) const;

  const Json* value_;
  const std::string* file_;
  std::string path_;
};

// An object of which every key must be known: those that were asked for are.
class JsonObject {
 public:
  // Throws Error if it is not an object.
  explicit JsonObject(JsonItem item);
  JsonObject(const Json& value, const std::string& file, std::string path = {})
      : JsonObject(JsonItem(value, file, std::move(path))) {}
  JsonObject(const Json& value, std::string&& file, std::string path = {}) = delete;

  const JsonItem& item() const { return item_; }
  bool has(std::string_view key) { return find(key) != nullptr; }
  const Json* find(std::string_view key);
  std::optional<JsonItem> optional(std::string_view key);
  JsonItem required(std::string_view key);  // throws Error if it is missing
  std::optional<JsonObject> optional_object(std::string_view key);
  JsonObject required_object(std::string_view key);

  // Leave the target as it is if the key is absent.
  void read_number(std::string_view key, double& out, Range range = {});
  void read_integer(std::string_view key, std::int64_t& out, std::int64_t low, std::int64_t high);
  void read_text(std::string_view key, std::string& out, std::size_t longest_bytes = 10'000);
  void read_bool(std::string_view key, bool& out);
  void read_numbers(std::string_view key, double* out, std::size_t count, Range range = {});

  // What strangers keep under "extra": an object, empty if there is none.
  Json extra();

  // Throws Error unless `format` is `format` and `version` is 1.
  void require_format(std::string_view format);
  // Throws Error for a key that was never asked for.
  void finish() const;

  // Names a key of this object, there or not.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

 private:
  std::string path_of(std::string_view key) const;

  JsonItem item_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace asperity
