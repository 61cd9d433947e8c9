#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "asperity/scene/haptic_experience.h"

namespace asperity {

// What HJIF and HMPG have in common. `format` is the name that begins an error's message.

inline constexpr const char* kHapticVersion = "2023";
inline constexpr const char* kHapticProfile = "Main";
// Dates are zeros, so that the same experience gives the same bytes.
inline constexpr const char* kHapticDate = "0000";

// 1, or 2 where a perception has more than 128 channels.
int haptic_level(const HapticExperience& experience);

// Throws Error for a timescale outside 1 to 48000, or without a perception.
void check_haptic_experience(const HapticExperience& experience, const std::string& format);

// Throws Error for a channel without keyframes, positions that do not rise from 0, an amplitude outside −1 to 1, or a
// gain that is not finite.
void check_haptic_channel(const HapticChannel& channel, const std::string& format);

// Keyframes begin to end, end excluded.
struct HapticEffect {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// A channel's curve as effects of at most kLongestHapticEffect and 43000 keyframes (a packet of HMPG has room for
// them); each begins with the last keyframe of the one before. Throws Error as check_haptic_channel, and for two
// keyframes that are further apart than an effect is long.
std::vector<HapticEffect> haptic_effects(const HapticChannel& channel, const std::string& format);

}  // namespace asperity
