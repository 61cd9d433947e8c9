#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace asperity {

// Consistent overhead byte stuffing (Cheshire and Baker, IEEE/ACM Trans. Networking 7(2), 1999): any bytes as a block
// without a zero byte, so that a zero byte can end it. A code byte c is followed by c − 1 bytes as they are and stands,
// unless it is FFh or the last, for these and one zero byte.

// The most bytes that `size` bytes become; the delimiter is not among them.
constexpr std::size_t cobs_bound(std::size_t size) { return size + size / 254 + 1; }

// Appends the block of `data` to `out`, without a delimiter.
void append_cobs(std::span<const std::uint8_t> data, std::vector<std::uint8_t>& out);

// Puts the bytes that `block` (without its delimiter) stands for into `out` and gives their number; nullopt if `block`
// is empty, holds a zero byte at a code's place, ends inside a group or has more bytes than `out` holds. A zero byte
// among the bytes of a group is taken as it is: whoever splits at zero bytes never passes one.
std::optional<std::size_t> decode_cobs(std::span<const std::uint8_t> block, std::span<std::uint8_t> out) noexcept;

}  // namespace asperity
