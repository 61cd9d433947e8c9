#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace asperity {

// CRC-32/ISO-HDLC, as in Ethernet, PNG and zip: polynomial 04C11DB7h reflected, start and final XOR FFFFFFFFh. Of the
// ASCII bytes "123456789" it is CBF43926h. By zlib.
std::uint32_t crc32(std::span<const std::uint8_t> bytes) noexcept;
std::uint32_t crc32(std::string_view bytes) noexcept;

// Of what has the CRC-32 `before` (0: nothing yet) with `bytes` behind it.
std::uint32_t crc32_of_more(std::uint32_t before, std::string_view bytes) noexcept;

}  // namespace asperity
