#include "asperity/base/crc32.h"

#include <zlib.h>

namespace asperity {

std::uint32_t crc32(std::span<const std::uint8_t> bytes) noexcept {
  // zlib takes a null pointer for the question after its start value, which is 0 too.
  return static_cast<std::uint32_t>(::crc32_z(0, bytes.data(), bytes.size()));
}

std::uint32_t crc32(std::string_view bytes) noexcept {
  return crc32({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

std::uint32_t crc32_of_more(std::uint32_t before, std::string_view bytes) noexcept {
  if (bytes.empty()) return before;
  return static_cast<std::uint32_t>(::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace asperity
