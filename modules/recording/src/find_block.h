#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "block_checksums.h"

namespace asperity {

// The first place in `content` from `first` on, and before `last`, where `block` begins: `first` itself or the begin of
// a line. By the CRC-32 of what lies before each place, so that every byte is summed twice at most, however many places
// there are; what was summed is added to `bytes_summed`.
std::optional<std::uint64_t> find_block(std::string_view content, std::uint64_t first, std::uint64_t last,
                                        const BlockChecksum& block, std::uint64_t& bytes_summed);

}  // namespace asperity
