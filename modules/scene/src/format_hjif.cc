#include "asperity/scene/format_hjif.h"

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"

namespace asperity {

namespace {

constexpr std::size_t kMostChannelsOfLevel1 = 128;

[[noreturn]] void fail_hjif(const std::string& message) { throw Error("HJIF: " + message); }

void check_hjif_channel(const HapticChannel& channel) {
  const std::string what = "the channel '" + printable(channel.description, 80) + "'";
  if (channel.keyframes.empty()) fail_hjif(what + " has no keyframes");
  if (channel.keyframes.front().position != 0) fail_hjif(what + " does not begin at 0");
  if (!std::isfinite(channel.gain)) fail_hjif(what + " has a gain of " + number_text(channel.gain));
  for (std::size_t i = 0; i < channel.keyframes.size(); ++i) {
    if (i > 0 && channel.keyframes[i].position <= channel.keyframes[i - 1].position)
      fail_hjif(what + ": keyframe " + std::to_string(i) + " is not behind the one before");
    if (!(std::abs(channel.keyframes[i].amplitude) <= 1.0))
      fail_hjif(what + ": keyframe " + std::to_string(i) + " has an amplitude of " +
                number_text(channel.keyframes[i].amplitude));
  }
}

Json hjif_effects(const HapticChannel& channel) {
  Json out = Json::array();
  const auto& frames = channel.keyframes;
  for (std::size_t begin = 0; begin < frames.size();) {
    std::size_t end = begin + 1;
    while (end < frames.size() && frames[end].position - frames[begin].position <= kLongestHapticEffect) ++end;
    if (end == begin + 1 && end < frames.size()) fail_hjif("two keyframes are further apart than an effect is long");
    Json keyframes = Json::array();
    for (std::size_t i = begin; i < end; ++i)
      keyframes.push_back({{"relative_position", frames[i].position - frames[begin].position},
                           {"amplitude_modulation", frames[i].amplitude}});
    Json effect;
    effect["effect_type"] = "Basis";
    effect["position"] = frames[begin].position;
    effect["phase"] = 0.0;
    effect["base_signal"] = "Sine";
    effect["keyframes"] = std::move(keyframes);
    out.push_back(std::move(effect));
    // The next effect begins with the last keyframe of this one.
    begin = end == frames.size() ? end : end - 1;
  }
  return out;
}

Json hjif_channel(const HapticChannel& channel, std::size_t id) {
  check_hjif_channel(channel);
  Json band;
  band["band_type"] = "Curve";
  band["curve_type"] = "Linear";
  band["lower_frequency_limit"] = 0;
  band["upper_frequency_limit"] = channel.highest_frequency;
  band["effects"] = hjif_effects(channel);
  Json out;
  out["id"] = id;
  out["description"] = printable(channel.description, 255);
  out["gain"] = channel.gain;
  out["mixing_coefficient"] = 1.0;
  out["body_part_mask"] = 0;
  out["bands"] = Json::array();
  out["bands"].push_back(std::move(band));
  return out;
}

Json hjif_perception(const HapticPerception& perception, std::size_t id) {
  Json out;
  out["id"] = id;
  out["avatar_id"] = 0;
  out["description"] = printable(perception.description, 255);
  out["perception_modality"] = kHapticModalityNames[static_cast<std::size_t>(perception.modality)];
  out["unit_exponent"] = perception.unit_exponent;
  out["perception_unit_exponent"] = perception.perception_unit_exponent;
  out["reference_devices"] = Json::array();
  out["effect_library"] = Json::array();
  out["channels"] = Json::array();
  for (std::size_t i = 0; i < perception.channels.size(); ++i)
    out["channels"].push_back(hjif_channel(perception.channels[i], i));
  return out;
}

}  // namespace

std::string format_hjif(const HapticExperience& experience) {
  if (experience.timescale < 1 || experience.timescale > kHighestHapticTimescale)
    fail_hjif("a timescale of " + std::to_string(experience.timescale) + "; 1 to " +
              std::to_string(kHighestHapticTimescale));
  if (experience.perceptions.empty()) fail_hjif("an experience without perceptions");
  int level = 1;
  for (const HapticPerception& perception : experience.perceptions)
    if (perception.channels.size() > kMostChannelsOfLevel1) level = 2;
  Json out;
  out["version"] = "2023";
  out["profile"] = "Main";
  out["level"] = level;
  out["date"] = "0000";
  out["description"] = printable(experience.description, 255);
  out["timescale"] = experience.timescale;
  out["avatars"] = Json::array();
  out["perceptions"] = Json::array();
  for (std::size_t i = 0; i < experience.perceptions.size(); ++i)
    out["perceptions"].push_back(hjif_perception(experience.perceptions[i], i));
  out["syncs"] = Json::array();
  return out.dump_repaired(2) + "\n";
}

}  // namespace asperity
