#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "asperity/base/config.h"
#include "asperity/recording/read_limits.h"

namespace asperity {

// `text` as JSON. Throws Error with file, line and column for bad syntax, text that is not UTF-8, a
// key given twice, nesting too deep or too many values.
nlohmann::json parse_json(std::string_view text, const std::string& name, const ReadLimits& limits);

// An object of a file whose every key must be known. Each read_… leaves its target as it is if the
// key is absent, and throws Error naming file and key if the value is of another type or out of range.
class JsonObject {
 public:
  // `path` is the object's place in the file, "" for the file itself. Throws Error if not an object.
  JsonObject(const nlohmann::json& value, std::string name, std::string path);

  // The value of `key`, which becomes a known key, or nullptr.
  const nlohmann::json* find(const std::string& key);
  // Throws Error unless the key is there.
  const nlohmann::json& require(const std::string& key);
  std::optional<JsonObject> object(const std::string& key);
  JsonObject required_object(const std::string& key);

  void read_number(const std::string& key, double& out, Range range = {});
  void read_integer(const std::string& key, std::int64_t& out, std::int64_t low, std::int64_t high);
  void read_text(const std::string& key, std::string& out);
  void read_bool(const std::string& key, bool& out);
  void read_numbers(const std::string& key, double* out, std::size_t count, Range range = {});
  void read_vector(const std::string& key, Eigen::Vector3d& out, Range range = {});
  // 3 rows of equal length, of which `columns` lists the lengths allowed.
  void read_matrix(const std::string& key, Eigen::Matrix<double, 3, Eigen::Dynamic>& out, const std::set<int>& columns);
  // Must be an object; empty if there is none.
  nlohmann::json read_extra();

  // Throws Error unless `format` is `format` and `version` is 1.
  void require_format(std::string_view format);
  // Throws Error for a key that was never asked for.
  void finish() const;
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  std::string place(const std::string& key) const;  // the dotted path of a key
  const std::string& name() const { return name_; }

 private:
  double number_of(const nlohmann::json& value, const std::string& key, Range range) const;

  const nlohmann::json* value_;
  std::string name_;
  std::string path_;
  std::set<std::string> known_;
};

}  // namespace asperity
