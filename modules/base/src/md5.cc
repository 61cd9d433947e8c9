#include "asperity/base/md5.h"

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

// The sixteen steps of one round: unrolled, the words' places and the turns are constants.
template <int kRound>
inline void add_round(State& state, const std::array<std::uint32_t, 16>& word,
                      const std::array<std::uint32_t, 64>& table) {
  constexpr std::array<std::array<int, 4>, 4> kTurns{
      {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}}};
  constexpr std::array<std::size_t, 4> kFirst{0, 1, 5, 0}, kStep{1, 5, 3, 7};
  auto [a, b, c, d] = state;
#pragma GCC unroll 16
  for (std::size_t i = 0; i < 16; ++i) {
    std::uint32_t mixed = 0;
    if constexpr (kRound == 0) mixed = (b & c) | (~b & d);
    if constexpr (kRound == 1) mixed = (d & b) | (~d & c);
    if constexpr (kRound == 2) mixed = b ^ c ^ d;
    if constexpr (kRound == 3) mixed = c ^ (b | ~d);
    const std::uint32_t sum = a + mixed + table[16 * kRound + i] + word[(kFirst[kRound] + kStep[kRound] * i) % 16];
    a = d;
    d = c;
    c = b;
    b += std::rotl(sum, kTurns[kRound][i % 4]);
  }
  state = {a, b, c, d};
}

void add_block(State& state, const char* block) {
  static const std::array<std::uint32_t, 64> table = sine_table();
  std::array<std::uint32_t, 16> word{};
  for (std::size_t i = 0; i < 64; ++i)
    word[i / 4] |= static_cast<std::uint32_t>(static_cast<unsigned char>(block[i])) << (8 * (i % 4));
  State mixed = state;
  add_round<0>(mixed, word, table);
  add_round<1>(mixed, word, table);
  add_round<2>(mixed, word, table);
  add_round<3>(mixed, word, table);
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += mixed[i];
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
