#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace asperity {

// The integer whose bytes, least significant first, begin at `at`, which moves behind them; they must be there.
template <class Integer>
Integer take_little_endian(std::span<const std::uint8_t> bytes, std::size_t& at) noexcept {
  std::make_unsigned_t<Integer> value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    value = static_cast<std::make_unsigned_t<Integer>>(value | static_cast<std::make_unsigned_t<Integer>>(bytes[at + i])
                                                                   << (8 * i));
  }
  at += sizeof(Integer);
  return static_cast<Integer>(value);
}

template <class Integer>
void append_little_endian(std::vector<std::uint8_t>& out, Integer value) {
  const auto bits = static_cast<std::make_unsigned_t<Integer>>(value);
  for (std::size_t i = 0; i < sizeof(Integer); ++i) out.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
}

}  // namespace asperity
