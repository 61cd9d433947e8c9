#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace asperity {

// Words mixed one after another by the finaliser of SplitMix64 (Steele, Lea and Flood 2014): a number for what a
// texture feels like.
class TextureHash {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) + 0x9e3779b97f4a7c15;
    value_ = (value_ ^ (value_ >> 30)) * 0xbf58476d1ce4e5b9;
    value_ = (value_ ^ (value_ >> 27)) * 0x94d049bb133111eb;
    value_ ^= value_ >> 31;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    for (const Value& value : values) {
      if constexpr (std::is_integral_v<Value>)
        add(static_cast<std::uint64_t>(value));
      else
        add(value);
    }
  }
  template <class... Numbers>
  requires(sizeof...(Numbers) > 1) void add(const Numbers&... numbers) { (add(numbers), ...); }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace asperity
