#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace asperity {

// The number whose bytes begin at `bytes`, in the given order; they must be there.
template <class Number>
Number load_number(const void* bytes, std::endian order) noexcept {
  std::array<std::byte, sizeof(Number)> copy;
  std::memcpy(copy.data(), bytes, sizeof(Number));
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

// The number whose bytes, least significant first, begin at `at`, which moves behind them; they must be there.
template <class Number>
Number take_little_endian(std::span<const std::uint8_t> bytes, std::size_t& at) noexcept {
  const auto number = load_number<Number>(bytes.data() + at, std::endian::little);
  at += sizeof(Number);
  return number;
}

// Appends a number's bytes, least significant first, to a string or a vector of bytes.
template <class Number, class Bytes>
void append_little_endian(Bytes& out, Number number) {
  auto bytes = std::bit_cast<std::array<typename Bytes::value_type, sizeof(Number)>>(number);
  if constexpr (std::endian::native != std::endian::little) std::reverse(bytes.begin(), bytes.end());
  if constexpr (requires { out.append(bytes.data(), bytes.size()); }) {
    out.append(bytes.data(), bytes.size());
  } else {
    out.insert(out.end(), bytes.begin(), bytes.end());
  }
}

}  // namespace asperity
