#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace asperity {

// The MD5 sum (RFC 1321) of bytes that come in pieces. A check against damage, not against malice.
class Md5 {
 public:
  void add(std::string_view piece);
  // As 32 hexadecimal digits; nothing may be added afterwards.
  std::string hex();

 private:
  std::array<std::uint32_t, 4> state_{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  std::uint64_t bytes_ = 0;
  std::string rest_;  // fewer than 64 bytes, which make no block yet
};

std::string md5_hex(std::string_view data);

// The sum of a file, which is never in memory as a whole. Throws Error naming it if it is no regular file, has more
// than `limit_bytes` or cannot be read.
std::string md5_hex_of_file(const std::filesystem::path& path, std::uint64_t limit_bytes);

}  // namespace asperity
