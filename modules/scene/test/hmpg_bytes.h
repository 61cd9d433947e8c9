#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "asperity/scene/haptic_experience.h"

namespace asperity {

// HMPG files that are put together field by field, as the layout in format_hmpg.h states them.

// A value and its number of bits.
using Field = std::pair<std::uint64_t, int>;

inline std::string bytes_of(const std::vector<Field>& fields) {
  std::string bits;
  for (const auto& [value, width] : fields)
    for (int i = width - 1; i >= 0; --i) bits += (value >> i) % 2 == 1 ? '1' : '0';
  while (bits.size() % 8 != 0) bits += '0';
  std::string out;
  for (std::size_t i = 0; i < bits.size(); i += 8) out += static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2));
  return out;
}

inline std::string unit(int type, int duration, std::uint64_t length) {
  return bytes_of({{type, 6}, {0, 2}, {0, 4}, {duration, 24}, {length, 32}, {0, 4}});
}

inline std::string packet(int type, std::uint64_t length) { return bytes_of({{type, 6}, {length, 17}, {0, 1}}); }

inline HapticExperience small_texture() {
  HapticExperience out;
  out.description = "d";
  HapticPerception& texture = out.perceptions.emplace_back();
  texture.description = "t";
  HapticChannel& channel = texture.channels.emplace_back();
  channel.description = "c";
  channel.gain = 2e-5;
  channel.highest_frequency = 10000;
  channel.keyframes = {{0, -1.0}, {100, 0.2}, {150, 1.0}};
  return out;
}

// 32 + 32 + 24 + 24 + 1 bits are 15 bytes, and so on; the lengths below are counted by hand.
inline std::string small_texture_bytes() {
  std::string out = unit(0, 0, 103);
  out += packet(11, 15) + bytes_of({{0, 32}, {1000, 32}, {0, 24}, {0, 24}, {0, 1}});
  out += packet(1, 20) + "\x04" + "2023" + "\x04" + "Main" + "\x01" + "\x04" + "0000" + "\x01" + "d" +
         bytes_of({{1, 8}, {0, 8}});
  out += packet(2, 14) + bytes_of({{0, 8},
                                   {0, 8},
                                   {1, 8},
                                   {'t', 8},
                                   {10, 8},  // VibrotactileTexture
                                   {0, 8},
                                   {0, 16},
                                   {0, 1},
                                   {0xfa, 8},  // −6: positions in µm
                                   {0xfa, 8},  // −6: the gain below in µm
                                   {0, 8},
                                   {1, 16}});
  // (20 + 10000)/20000 · (2³² − 1) = 2151778614.8; 1/10000 · (2³² − 1) = 429496.7
  out += packet(3, 27) + bytes_of({{0, 16},
                                   {0, 8},
                                   {0, 8},
                                   {1, 8},
                                   {'c', 8},
                                   {255, 8},
                                   {2151778615, 32},
                                   {429497, 32},
                                   {1, 8},
                                   {0, 32},
                                   {0, 32},
                                   {0, 16},
                                   {1, 8}});
  out += packet(4, 12) + bytes_of({{0, 8}, {0, 8}, {0, 16}, {0, 8}, {1, 3}, {2, 4}, {0, 16}, {10000, 16}, {1, 16}});
  out += unit(2, 0, 26) + packet(5, 23);
  // (−1 + 1)/2 · 255 = 0, (0.2 + 1)/2 · 255 = 153, (1 + 1)/2 · 255 = 255
  return out + bytes_of({{0, 1},
                         {0, 8},
                         {0, 16},
                         {0, 8},
                         {1, 16},
                         {0, 16},
                         {0, 2},
                         {0, 25},
                         {0, 1},
                         {3, 16},
                         {0, 8},
                         {0, 16},
                         {153, 8},
                         {100, 16},
                         {255, 8},
                         {150, 16}});
}

inline HapticExperience long_vibration() {
  HapticExperience out;
  out.timescale = 8000;
  HapticPerception& vibration = out.perceptions.emplace_back();
  vibration.modality = HapticModality::kVibrotactile;
  vibration.unit_exponent = -3;
  HapticChannel& channel = vibration.channels.emplace_back();
  for (int i = 0; i <= 100; ++i) channel.keyframes.push_back({1000 * i, std::sin(0.1 * i)});
  return out;
}

}  // namespace asperity
