#pragma once

#include <cstdint>
#include <span>

namespace asperity {

// CRC-32/ISO-HDLC, as in Ethernet and zlib: polynomial 04C11DB7h reflected, start and final XOR FFFFFFFFh. Of the ASCII
// bytes "123456789" it is CBF43926h.
std::uint32_t crc32(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace asperity
