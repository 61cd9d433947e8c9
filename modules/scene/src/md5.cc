#include "asperity/scene/md5.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "asperity/base/little_endian.h"

namespace asperity {
namespace {

using State = std::array<std::uint32_t, 4>;

// RFC 1321: T[i] = floor(2^32 |sin(i + 1)|).
std::array<std::uint32_t, 64> sine_table() {
  std::array<std::uint32_t, 64> table;
  for (std::size_t i = 0; i < 64; ++i)
    table[i] = static_cast<std::uint32_t>(std::floor(std::abs(std::sin(static_cast<double>(i + 1))) * 4294967296.0));
  return table;
}

void add_block(State& state, const char* block) {
  static const std::array<std::uint32_t, 64> table = sine_table();
  constexpr std::array<std::array<int, 4>, 4> kTurns{
      {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}}};
  std::array<std::uint32_t, 16> word{};
  for (std::size_t i = 0; i < 64; ++i)
    word[i / 4] |= static_cast<std::uint32_t>(static_cast<unsigned char>(block[i])) << (8 * (i % 4));
  auto [a, b, c, d] = state;
  for (std::size_t i = 0; i < 64; ++i) {
    std::uint32_t mixed = 0;
    std::size_t place = 0;
    switch (i / 16) {
      case 0:
        mixed = (b & c) | (~b & d);
        place = i;
        break;
      case 1:
        mixed = (d & b) | (~d & c);
        place = (5 * i + 1) % 16;
        break;
      case 2:
        mixed = b ^ c ^ d;
        place = (3 * i + 5) % 16;
        break;
      default:
        mixed = c ^ (b | ~d);
        place = (7 * i) % 16;
    }
    const std::uint32_t sum = a + mixed + table[i] + word[place];
    a = d;
    d = c;
    c = b;
    b += std::rotl(sum, kTurns[i / 16][i % 4]);
  }
  state[0] += a;
  state[1] += b;
  state[2] += c;
  state[3] += d;
}

}  // namespace

std::string md5_hex(std::string_view data) {
  State state{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  std::size_t at = 0;
  for (; at + 64 <= data.size(); at += 64) add_block(state, data.data() + at);
  std::string tail(data.substr(at));
  tail += '\x80';
  while (tail.size() % 64 != 56) tail += '\0';
  append_little_endian(tail, 8 * static_cast<std::uint64_t>(data.size()));
  for (std::size_t i = 0; i < tail.size(); i += 64) add_block(state, tail.data() + i);
  std::string out;
  for (const std::uint32_t part : state) {
    for (int byte = 0; byte < 4; ++byte) {
      constexpr const char* kDigits = "0123456789abcdef";
      out += kDigits[part >> (8 * byte + 4) & 0xF];
      out += kDigits[part >> (8 * byte) & 0xF];
    }
  }
  return out;
}

}  // namespace asperity
