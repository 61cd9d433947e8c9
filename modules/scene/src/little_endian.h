#pragma once

#include <cstdint>
#include <string>

namespace asperity {

// Appends the lowest `bytes` bytes of a number, the lowest first.
inline void append_little_endian(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

}  // namespace asperity
