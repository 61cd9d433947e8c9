#include "asperity/link/cobs.h"

#include <cstring>

namespace asperity {

namespace {

constexpr std::size_t kGroup_bytes = 254;

}  // namespace

void append_cobs(std::span<const std::uint8_t> data, std::vector<std::uint8_t>& out) {
  out.reserve(out.size() + cobs_bound(data.size()));
  std::size_t code = out.size();
  out.push_back(1);
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (data[i] != 0) {
      out.push_back(data[i]);
      ++out[code];
      // A full group stands for no zero byte, so it needs another group behind it only if more follows.
      if (out[code] != kGroup_bytes + 1 || i + 1 == data.size()) continue;
    }
    code = out.size();
    out.push_back(1);
  }
}

std::optional<std::size_t> decode_cobs(std::span<const std::uint8_t> block, std::span<std::uint8_t> out) noexcept {
  if (block.empty()) return std::nullopt;
  std::size_t written = 0;
  std::size_t at = 0;
  while (at < block.size()) {
    const std::size_t code = block[at++];
    if (code == 0 || code - 1 > block.size() - at || code - 1 > out.size() - written) return std::nullopt;
    if (code > 1) std::memcpy(out.data() + written, block.data() + at, code - 1);
    written += code - 1;
    at += code - 1;
    if (code == kGroup_bytes + 1 || at == block.size()) continue;
    if (written == out.size()) return std::nullopt;
    out[written++] = 0;
  }
  return written;
}

}  // namespace asperity
