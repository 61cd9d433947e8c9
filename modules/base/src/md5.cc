#include "asperity/base/md5.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "asperity/base/little_endian.h"
#include "open_file.h"

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

void Md5::add(std::string_view piece) {
  constexpr std::size_t kBlock = 64;
  bytes_ += piece.size();
  if (!rest_.empty()) {
    const std::size_t taken = std::min(piece.size(), kBlock - rest_.size());
    rest_.append(piece.substr(0, taken));
    piece.remove_prefix(taken);
    if (rest_.size() < kBlock) return;
    add_block(state_, rest_.data());
    rest_.clear();
  }
  for (; piece.size() >= kBlock; piece.remove_prefix(kBlock)) add_block(state_, piece.data());
  rest_.assign(piece);
}

std::string Md5::hex() {
  const std::uint64_t bits = 8 * bytes_;
  std::string tail = "\x80";
  while ((rest_.size() + tail.size()) % 64 != 56) tail += '\0';
  append_little_endian(tail, bits);
  add(tail);
  std::string out;
  for (const std::uint32_t part : state_) {
    for (int byte = 0; byte < 4; ++byte) {
      constexpr const char* kHexadecimal = "0123456789abcdef";
      out += kHexadecimal[part >> (8 * byte + 4) & 0xF];
      out += kHexadecimal[part >> (8 * byte) & 0xF];
    }
  }
  return out;
}

std::string md5_hex(std::string_view data) {
  Md5 sum;
  sum.add(data);
  return sum.hex();
}

std::string md5_hex_of_file(const std::filesystem::path& path, std::uint64_t limit_bytes) {
  OpenFile file = open_file(path, limit_bytes);
  std::string piece(std::size_t{1} << 16, '\0');
  Md5 sum;
  do {
    file.stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    check_read(file.stream, path);
    sum.add(std::string_view(piece).substr(0, static_cast<std::size_t>(file.stream.gcount())));
  } while (file.stream);
  return sum.hex();
}

}  // namespace asperity
