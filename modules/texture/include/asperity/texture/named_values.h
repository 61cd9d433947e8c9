#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace asperity {

struct NamedValue;

// Values by name, in the order in which they are shown: what a texture model or its fit reports.
class NamedValues {
 public:
  using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, NamedValues>;

  // Appends a value.
  template <class T>
  NamedValues& add(std::string_view name, const T& value) {
    if constexpr (std::is_same_v<T, bool> || std::is_floating_point_v<T>)
      append(name, value);
    else if constexpr (std::is_integral_v<T>)
      append(name, static_cast<std::int64_t>(value));
    else if constexpr (std::is_convertible_v<T, std::string_view>)
      append(name, std::string(std::string_view(value)));
    else
      append(name, value);
    return *this;
  }

  // Null if there is none of this name.
  const Value* find(std::string_view name) const;

  const std::vector<NamedValue>& all() const { return values_; }

 private:
  void append(std::string_view name, Value value);

  std::vector<NamedValue> values_;
};

struct NamedValue {
  std::string name;
  NamedValues::Value value;
};

}  // namespace asperity
