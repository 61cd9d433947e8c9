#pragma once

#include <limits>
#include <string>
#include <vector>

#include "located_json.h"

namespace asperity {

inline constexpr double kLargestNumber = std::numeric_limits<double>::max();
// Larger heights are a mistake of unit, and their sums could overflow.
inline constexpr double kLargestHeight_m = 1e3;
inline constexpr std::size_t kMostCoefficients = 65536;

// Values of a texture file, checked; `path` is where `value` stands ("fourier1d.a_m"). Each throws Error
// with file, line and key.
double read_number(const LocatedJson& json, const LocatedJson::Json& value, const std::string& path, double low,
                   double high);
std::string read_text(const LocatedJson& json, const LocatedJson::Json& value, const std::string& path);
std::vector<double> read_numbers(const LocatedJson& json, const LocatedJson::Json& value, const std::string& path,
                                 double largest, std::size_t most = kMostCoefficients);

// The member `key` of the object at `path`, which must be there.
double required_number(const LocatedJson& json, const std::string& path, const char* key, double low, double high);
std::int64_t required_integer(const LocatedJson& json, const std::string& path, const char* key, std::int64_t low,
                              std::int64_t high);
std::string required_text(const LocatedJson& json, const std::string& path, const char* key);
std::vector<double> required_numbers(const LocatedJson& json, const std::string& path, const char* key, double largest,
                                     std::size_t most = kMostCoefficients);
// The place of a text among `names`.
std::size_t required_choice(const LocatedJson& json, const std::string& path, const char* key,
                            const std::vector<std::string_view>& names);
// `fallback` if the member is not there.
double optional_number(const LocatedJson& json, const std::string& path, const char* key, double low, double high,
                       double fallback);

// Values as they are written. Each throws Error naming `key` for what a file cannot hold.
std::string number_json(double value, const char* key);
std::string text_json(const std::string& value, const char* key);
std::string numbers_json(const std::vector<double>& values, const char* key);

// The text of a model's block, one key a line, two levels deep.
class BlockText {
 public:
  BlockText& add(const char* key, const std::string& value) {
    text_ += std::string(text_.empty() ? "{\n" : ",\n") + "    \"" + key + "\": " + value;
    return *this;
  }
  BlockText& add(const char* key, double value) { return add(key, number_json(value, key)); }
  BlockText& add(const char* key, const std::vector<double>& values) { return add(key, numbers_json(values, key)); }
  std::string str() const { return text_ + "\n  }"; }

 private:
  std::string text_;
};

}  // namespace asperity
