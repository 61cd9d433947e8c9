#include "asperity/scene/format_hjif.h"

#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "haptic_parts.h"

namespace asperity {

namespace {

Json hjif_effects(const HapticChannel& channel) {
  Json out = Json::array();
  const auto& frames = channel.keyframes;
  for (const auto& [begin, end] : haptic_effects(channel, "HJIF")) {
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
  }
  return out;
}

Json hjif_channel(const HapticChannel& channel, std::size_t id) {
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
  check_haptic_experience(experience, "HJIF");
  Json out;
  out["version"] = kHapticVersion;
  out["profile"] = kHapticProfile;
  out["level"] = haptic_level(experience);
  out["date"] = kHapticDate;
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
