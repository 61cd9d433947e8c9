#include "find_block.h"

#include <array>
#include <bit>

#include "asperity/base/crc32.h"

namespace asperity {

namespace {

// A CRC-32 is linear over GF(2): what `count` bytes behind A make of its sum is a matrix of 32 × 32 bits, kept by its
// columns. The sum of A with B behind it is that matrix times the sum of A, plus the sum of B.
class BehindBytes {
 public:
  explicit BehindBytes(std::uint64_t count) {
    // One bit: the register moves down by one, and takes the reflected polynomial if a one leaves it.
    Columns power;
    power[0] = 0xEDB88320u;
    for (std::size_t k = 1; k < 32; ++k) power[k] = 1u << (k - 1);
    for (int doubling = 0; doubling < 3; ++doubling) power = product(power, power);
    for (std::size_t k = 0; k < 32; ++k) columns_[k] = 1u << k;
    for (; count > 0; count >>= 1) {
      if ((count & 1) != 0) columns_ = product(power, columns_);
      power = product(power, power);
    }
  }
  std::uint32_t operator()(std::uint32_t sum) const { return times(columns_, sum); }

 private:
  using Columns = std::array<std::uint32_t, 32>;
  static std::uint32_t times(const Columns& matrix, std::uint32_t vector) {
    std::uint32_t out = 0;
    for (; vector != 0; vector &= vector - 1) out ^= matrix[static_cast<std::size_t>(std::countr_zero(vector))];
    return out;
  }
  static Columns product(const Columns& a, const Columns& b) {
    Columns out;
    for (std::size_t k = 0; k < 32; ++k) out[k] = times(a, b[k]);
    return out;
  }

  Columns columns_;
};

}  // namespace

std::optional<std::uint64_t> find_block(std::string_view content, std::uint64_t first, std::uint64_t last,
                                        const BlockChecksum& block, std::uint64_t& bytes_summed) {
  if (first >= last || first > content.size() || block.bytes > content.size() - first) return std::nullopt;
  const BehindBytes behind_block(block.bytes);
  std::uint32_t before = 0;  // the sum of [first, at)
  std::uint32_t through = crc32(content.substr(first, block.bytes));
  bytes_summed += block.bytes;
  for (std::uint64_t at = first; at < last;) {
    if ((through ^ behind_block(before)) == block.crc) return at;
    const std::size_t newline = content.find('\n', at);
    if (newline == std::string_view::npos || newline + 1 + block.bytes > content.size()) break;
    const std::uint64_t step = newline + 1 - at;
    before = crc32_of_more(before, content.substr(at, step));
    through = crc32_of_more(through, content.substr(at + block.bytes, step));
    bytes_summed += 2 * step;
    at += step;
  }
  return std::nullopt;
}

}  // namespace asperity
