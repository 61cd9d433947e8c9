#include "asperity/scene/format_hmpg.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "bit_writer.h"
#include "haptic_parts.h"
#include "hmpg_layout.h"

namespace asperity {

namespace {

[[noreturn]] void fail_hmpg(const std::string& message) { throw Error("HMPG: " + message); }

void put_hmpg_text(BitWriter& out, const std::string& text) {
  constexpr std::size_t kMost = 255, kLongestEnd = 18;  // of printable() behind its limit: an escape and "…"
  std::string cut = printable(text, kMost);
  if (cut.size() > kMost) cut = printable(text, kMost - kLongestEnd);
  out.put(static_cast<std::int64_t>(cut.size()), 8);
  out.put_text(cut);
}

std::string hmpg_packet(HmpgPacket type, const BitWriter& payload) {
  if (payload.bytes().size() > kLargestHmpgPacket_bytes) fail_hmpg("a packet is too large");
  BitWriter header;
  header.put(static_cast<int>(type), 6);
  header.put(static_cast<std::int64_t>(payload.bytes().size()), 17);
  header.put(0, 1);
  return header.bytes() + payload.bytes();
}

std::string hmpg_unit(HmpgUnit type, std::int64_t duration, const std::string& packets) {
  if (packets.size() > 0xffffffffu) fail_hmpg("a unit is too large");
  BitWriter header;
  header.put(static_cast<int>(type), 6);
  header.put(0, 2);
  header.put(0, 4);
  header.put(duration, 24);
  header.put(static_cast<std::int64_t>(packets.size()), 32);
  header.put(0, 4);
  return header.bytes() + packets;
}

// What gains are multiplied by 10 to the minus of, so that the greatest is at most kHighestHmpgGain.
int gain_exponent(const HapticPerception& perception) {
  double highest = 0.0;
  for (const HapticChannel& channel : perception.channels) highest = std::max(highest, std::abs(channel.gain));
  int out = 0;
  while (highest * std::pow(10.0, -out) > kHighestHmpgGain) out += 3;
  while (highest > 0.0 && highest * std::pow(10.0, 3 - out) <= kHighestHmpgGain &&
         perception.perception_unit_exponent + out - 3 >= -128)
    out -= 3;
  if (perception.perception_unit_exponent + out > 127) fail_hmpg("a gain is too large");
  return out;
}

bool is_temporal(const HapticPerception& perception) { return perception.modality == HapticModality::kVibrotactile; }

std::string hmpg_experience(const HapticExperience& experience) {
  BitWriter out;
  put_hmpg_text(out, kHapticVersion);
  put_hmpg_text(out, kHapticProfile);
  out.put(haptic_level(experience), 8);
  put_hmpg_text(out, kHapticDate);
  put_hmpg_text(out, experience.description);
  out.put(static_cast<std::int64_t>(experience.perceptions.size()), 8);
  out.put(0, 8);
  return hmpg_packet(HmpgPacket::kExperience, out);
}

std::string hmpg_perception(const HapticPerception& perception, std::size_t id) {
  BitWriter out;
  out.put(static_cast<std::int64_t>(id), 8);
  out.put(0, 8);
  put_hmpg_text(out, perception.description);
  out.put(kHmpgModalities[static_cast<std::size_t>(perception.modality)], 8);
  out.put(0, 8);
  out.put(0, 16);
  out.put(0, 1);
  out.put(perception.unit_exponent, 8);
  out.put(perception.perception_unit_exponent + gain_exponent(perception), 8);
  out.put(0, 8);
  out.put(static_cast<std::int64_t>(perception.channels.size()), 16);
  return hmpg_packet(HmpgPacket::kPerception, out);
}

// Where a channel is in the experience; its id is its band's too.
struct ChannelIds {
  std::size_t perception = 0;
  std::size_t channel = 0;
};

std::string hmpg_channel(const HapticChannel& channel, int exponent, const ChannelIds& ids) {
  BitWriter out;
  out.put(static_cast<std::int64_t>(ids.channel), 16);
  out.put(static_cast<std::int64_t>(ids.perception), 8);
  out.put(0, 8);
  put_hmpg_text(out, channel.description);
  out.put(kHmpgNoReferenceDevice, 8);
  out.put(hmpg_gain_code(channel.gain * std::pow(10.0, -exponent)), 32);
  out.put(hmpg_weight_code(1.0), 32);
  out.put(kHmpgBodyPartMask, 8);
  out.put(0, 32);
  out.put(0, 32);
  out.put(0, 16);
  out.put(1, 8);
  return hmpg_packet(HmpgPacket::kChannel, out);
}

std::string hmpg_band(const HapticChannel& channel, std::size_t effects, const ChannelIds& ids) {
  BitWriter out;
  out.put(static_cast<std::int64_t>(ids.channel), 8);
  out.put(static_cast<std::int64_t>(ids.perception), 8);
  out.put(static_cast<std::int64_t>(ids.channel), 16);
  out.put(0, 8);
  out.put(kHmpgCurveBand, 3);
  out.put(kHmpgLinearCurve, 4);
  out.put(0, 16);
  out.put(std::clamp(channel.highest_frequency, 0, kHighestHmpgFrequency), 16);
  if (effects > 0xffff) fail_hmpg("more than 65535 effects in a band");
  out.put(static_cast<std::int64_t>(effects), 16);
  return hmpg_packet(HmpgPacket::kBand, out);
}

// `position` is that of the effect behind the unit's begin.
std::string hmpg_data(const HapticChannel& channel, const HapticEffect& effect, std::size_t effect_id,
                      std::int64_t position, const ChannelIds& ids) {
  BitWriter out;
  out.put(0, 1);
  out.put(static_cast<std::int64_t>(ids.perception), 8);
  out.put(static_cast<std::int64_t>(ids.channel), 16);
  out.put(static_cast<std::int64_t>(ids.channel), 8);
  out.put(1, 16);
  out.put(static_cast<std::int64_t>(effect_id), 16);
  out.put(kHmpgBasisEffect, 2);
  out.put(position, 25);
  out.put(0, 1);
  out.put(static_cast<std::int64_t>(effect.end - effect.begin), 16);
  const std::int64_t begin = channel.keyframes[effect.begin].position;
  for (std::size_t i = effect.begin; i < effect.end; ++i) {
    out.put(hmpg_amplitude_code(channel.keyframes[i].amplitude), 8);
    out.put(channel.keyframes[i].position - begin, 16);
  }
  return hmpg_packet(HmpgPacket::kData, out);
}

// The effects of vibrations that begin at one tick: their packets, and the last tick of any of them.
struct TemporalPart {
  std::string packets;
  std::int64_t end = 0;
};

struct HmpgParts {
  std::string perceptions, channels, bands, spatial;
  std::map<std::int64_t, TemporalPart> temporal;
  std::size_t channel_count = 0;
  std::size_t effect_count = 0;
};

void add_channel(const HapticPerception& perception, const HapticChannel& channel, int exponent, std::size_t id,
                 HmpgParts& out) {
  const ChannelIds ids{id, out.channel_count++};
  if (out.channel_count > 256) fail_hmpg("more than 256 channels");
  const std::vector<HapticEffect> effects = haptic_effects(channel, "HMPG");
  out.channels += hmpg_channel(channel, exponent, ids);
  out.bands += hmpg_band(channel, effects.size(), ids);
  for (const HapticEffect& effect : effects) {
    const std::int64_t begin = channel.keyframes[effect.begin].position;
    if (out.effect_count > 0xffff) fail_hmpg("more than 65536 effects");
    if (is_temporal(perception)) {
      TemporalPart& part = out.temporal[begin];
      part.packets += hmpg_data(channel, effect, out.effect_count++, 0, ids);
      part.end = std::max(part.end, channel.keyframes[effect.end - 1].position);
    } else {
      if (begin > kLastHmpgPosition) fail_hmpg("a position of " + std::to_string(begin) + "; at most 16777215");
      out.spatial += hmpg_data(channel, effect, out.effect_count++, begin, ids);
    }
  }
}

// A unit's ticks are up to the next unit, of the last one up to behind its last keyframe.
std::vector<std::int64_t> unit_durations(const std::map<std::int64_t, TemporalPart>& temporal) {
  std::vector<std::int64_t> out;
  for (auto part = temporal.begin(); part != temporal.end(); ++part) {
    const auto next = std::next(part);
    out.push_back((next == temporal.end() ? part->second.end + 1 : next->first) - part->first);
    if (next != temporal.end() && part->second.end > next->first) fail_hmpg("effects of vibrations overlap");
  }
  return out;
}

std::string hmpg_timing(int timescale, const std::vector<std::int64_t>& durations) {
  std::int64_t nominal = 0, deviation = 0;
  if (!durations.empty()) {
    nominal = *std::max_element(durations.begin(), durations.end());
    deviation = nominal - *std::min_element(durations.begin(), durations.end());
  }
  BitWriter out;
  out.put(0, 32);
  out.put(timescale, 32);
  out.put(nominal, 24);
  out.put(deviation, 24);
  out.put(0, 1);
  return hmpg_packet(HmpgPacket::kInitializationTiming, out);
}

}  // namespace

std::string format_hmpg(const HapticExperience& experience) {
  check_haptic_experience(experience, "HMPG");
  if (experience.perceptions.size() > 255) fail_hmpg("more than 255 perceptions");
  HmpgParts parts;
  for (std::size_t i = 0; i < experience.perceptions.size(); ++i) {
    const HapticPerception& perception = experience.perceptions[i];
    for (const int exponent : {perception.unit_exponent, perception.perception_unit_exponent})
      if (exponent < -128 || exponent > 127) fail_hmpg("a unit exponent of " + std::to_string(exponent));
    for (const HapticChannel& channel : perception.channels) check_haptic_channel(channel, "HMPG");
    const int exponent = gain_exponent(perception);
    parts.perceptions += hmpg_perception(perception, i);
    for (const HapticChannel& channel : perception.channels) add_channel(perception, channel, exponent, i, parts);
  }
  const std::vector<std::int64_t> durations = unit_durations(parts.temporal);
  std::string out = hmpg_unit(HmpgUnit::kInitialization, 0,
                              hmpg_timing(experience.timescale, durations) + hmpg_experience(experience) +
                                  parts.perceptions + parts.channels + parts.bands);
  if (!parts.spatial.empty()) out += hmpg_unit(HmpgUnit::kSpatial, 0, parts.spatial);
  auto duration = durations.begin();
  for (const auto& [begin, part] : parts.temporal) out += hmpg_unit(HmpgUnit::kTemporal, *duration++, part.packets);
  return out;
}

double hmpg_value_error(const HapticPerception& perception, const HapticChannel& channel) {
  const int exponent = gain_exponent(perception);
  const double gain = hmpg_gain(hmpg_gain_code(channel.gain * std::pow(10.0, -exponent))) * std::pow(10.0, exponent);
  double out = 0.0;
  for (const HapticKeyframe& frame : channel.keyframes) {
    const double written = gain * hmpg_amplitude(hmpg_amplitude_code(frame.amplitude));
    out = std::max(out, std::abs(written - channel.gain * frame.amplitude));
  }
  return out * std::pow(10.0, perception.perception_unit_exponent);
}

}  // namespace asperity
