#include "haptic_parts.h"

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::size_t kMostChannelsOfLevel1 = 128;
constexpr std::size_t kMostKeyframes = 43000;

}  // namespace

int haptic_level(const HapticExperience& experience) {
  for (const HapticPerception& perception : experience.perceptions)
    if (perception.channels.size() > kMostChannelsOfLevel1) return 2;
  return 1;
}

void check_haptic_experience(const HapticExperience& experience, const std::string& format) {
  if (experience.timescale < 1 || experience.timescale > kHighestHapticTimescale)
    throw Error(format + ": a timescale of " + std::to_string(experience.timescale) + "; 1 to " +
                std::to_string(kHighestHapticTimescale));
  if (experience.perceptions.empty()) throw Error(format + ": an experience without perceptions");
}

void check_haptic_channel(const HapticChannel& channel, const std::string& format) {
  const std::string what = format + ": the channel '" + printable(channel.description, 80) + "'";
  if (channel.keyframes.empty()) throw Error(what + " has no keyframes");
  if (channel.keyframes.front().position != 0) throw Error(what + " does not begin at 0");
  if (!std::isfinite(channel.gain)) throw Error(what + " has a gain of " + number_text(channel.gain));
  for (std::size_t i = 0; i < channel.keyframes.size(); ++i) {
    if (i > 0 && channel.keyframes[i].position <= channel.keyframes[i - 1].position)
      throw Error(what + ": keyframe " + std::to_string(i) + " is not behind the one before");
    if (!(std::abs(channel.keyframes[i].amplitude) <= 1.0))
      throw Error(what + ": keyframe " + std::to_string(i) + " has an amplitude of " +
                  number_text(channel.keyframes[i].amplitude));
  }
}

std::vector<HapticEffect> haptic_effects(const HapticChannel& channel, const std::string& format) {
  check_haptic_channel(channel, format);
  const auto& frames = channel.keyframes;
  std::vector<HapticEffect> out;
  for (std::size_t begin = 0; begin < frames.size();) {
    std::size_t end = begin + 1;
    while (end < frames.size() && end - begin < kMostKeyframes &&
           frames[end].position - frames[begin].position <= kLongestHapticEffect)
      ++end;
    if (end == begin + 1 && end < frames.size())
      throw Error(format + ": two keyframes are further apart than an effect is long");
    out.push_back({begin, end});
    begin = end == frames.size() ? end : end - 1;
  }
  return out;
}

}  // namespace asperity
