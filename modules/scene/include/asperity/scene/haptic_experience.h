#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// What of ISO/IEC 23090-31 a texture needs: perceptions of channels, each one curve of keyframes.

// The positions of an effect's keyframes are at most this far behind the effect: the binary form has 16 bits for them.
inline constexpr std::int64_t kLongestHapticEffect = 65535;
// Ticks a second of the profile Main.
inline constexpr int kHighestHapticTimescale = 48000;

enum class HapticModality { kVibrotactile, kVibrotactileTexture, kStiffness, kFriction };
inline constexpr std::array<std::string_view, 4> kHapticModalityNames{"Vibrotactile", "VibrotactileTexture",
                                                                      "Stiffness", "Friction"};

// A value at a position, in the channel's units: amplitude · gain · 10^perception_unit_exponent.
struct HapticKeyframe {
  std::int64_t position = 0;  // of 10^unit_exponent m for textures, stiffness and friction; of 1/timescale s else
  double amplitude = 0.0;     // −1 to 1
};

// A channel of one band of straight pieces between keyframes.
struct HapticChannel {
  std::string description;
  double gain = 1.0;  // what an amplitude of 1 is, in 10^perception_unit_exponent of the perception's SI unit
  int highest_frequency = 0;
  std::vector<HapticKeyframe> keyframes;  // positions from 0, rising
};

struct HapticPerception {
  HapticModality modality = HapticModality::kVibrotactileTexture;
  std::string description;
  int unit_exponent = -6;            // positions are micrometres
  int perception_unit_exponent = 0;  // 0: values are metres, newtons, numbers or m/s²
  std::vector<HapticChannel> channels;
};

struct HapticExperience {
  std::string description;
  int timescale = 1000;  // ticks a second
  std::vector<HapticPerception> perceptions;
};

}  // namespace asperity
