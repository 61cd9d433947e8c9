// HMPG, the binary form: bytes that are put together here field by field, as the layout in format_hmpg.h states them,
// and what comes back from them.
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/scene/format_hjif.h"
#include "asperity/scene/format_hmpg.h"
#include "asperity/scene/parse_hmpg.h"
#include "painted_scene.h"

namespace asperity {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// A value and its number of bits.
using Field = std::pair<std::uint64_t, int>;

std::string bytes_of(const std::vector<Field>& fields) {
  std::string bits;
  for (const auto& [value, width] : fields)
    for (int i = width - 1; i >= 0; --i) bits += (value >> i) % 2 == 1 ? '1' : '0';
  while (bits.size() % 8 != 0) bits += '0';
  std::string out;
  for (std::size_t i = 0; i < bits.size(); i += 8) out += static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2));
  return out;
}

std::string unit(int type, int duration, std::uint64_t length) {
  return bytes_of({{type, 6}, {0, 2}, {0, 4}, {duration, 24}, {length, 32}, {0, 4}});
}

std::string packet(int type, std::uint64_t length) { return bytes_of({{type, 6}, {length, 17}, {0, 1}}); }

HapticExperience small_texture() {
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
std::string small_texture_bytes() {
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

TEST(FormatHmpg, HasTheBytesOfTheLayout) {
  const std::string expected = small_texture_bytes();
  ASSERT_EQ(expected.size(), 147u);
  EXPECT_EQ(format_hmpg(small_texture()), expected);
}

// PerceptionModality of the reference software at 1bc5bef5: Vibrotactile 6, VibrotactileTexture 10, Stiffness 12,
// Friction 13. An earlier version had 11 and 12 for the last two.
TEST(FormatHmpg, NumbersTheModalities) {
  const std::size_t at = 9 + 18 + 23 + 3 + 4;
  const std::vector<std::pair<HapticModality, char>> numbers{{HapticModality::kVibrotactile, 6},
                                                             {HapticModality::kVibrotactileTexture, 10},
                                                             {HapticModality::kStiffness, 12},
                                                             {HapticModality::kFriction, 13}};
  for (const auto& [modality, number] : numbers) {
    HapticExperience experience = small_texture();
    experience.perceptions[0].modality = modality;
    const std::string bytes = format_hmpg(experience);
    EXPECT_EQ(bytes[at], number);
    EXPECT_EQ(parse_hmpg(bytes, "x").perceptions[0].modality, modality);
  }
}

TEST(ParseHmpg, ReadsTheBytesOfTheLayout) {
  const HapticExperience read = parse_hmpg(small_texture_bytes(), "small.hmpg");
  EXPECT_EQ(read.description, "d");
  EXPECT_EQ(read.timescale, 1000);
  ASSERT_EQ(read.perceptions.size(), 1u);
  const HapticPerception& texture = read.perceptions[0];
  EXPECT_EQ(texture.modality, HapticModality::kVibrotactileTexture);
  EXPECT_EQ(texture.description, "t");
  EXPECT_EQ(texture.unit_exponent, -6);
  EXPECT_EQ(texture.perception_unit_exponent, -6);
  ASSERT_EQ(texture.channels.size(), 1u);
  const HapticChannel& channel = texture.channels[0];
  EXPECT_EQ(channel.description, "c");
  EXPECT_NEAR(channel.gain, 20.0, 0.5 * 20000.0 / 4294967295.0);
  EXPECT_EQ(channel.highest_frequency, 10000);
  ASSERT_EQ(channel.keyframes.size(), 3u);
  EXPECT_EQ(channel.keyframes[1].position, 100);
  EXPECT_NEAR(channel.keyframes[0].amplitude, -1.0, 1e-15);
  EXPECT_NEAR(channel.keyframes[1].amplitude, 0.2, 1e-15);  // one of the codes
  EXPECT_NEAR(channel.keyframes[2].amplitude, 1.0, 1e-15);
}

HapticExperience long_vibration() {
  HapticExperience out;
  out.timescale = 8000;
  HapticPerception& vibration = out.perceptions.emplace_back();
  vibration.modality = HapticModality::kVibrotactile;
  vibration.unit_exponent = -3;
  HapticChannel& channel = vibration.channels.emplace_back();
  for (int i = 0; i <= 100; ++i) channel.keyframes.push_back({1000 * i, std::sin(0.1 * i)});
  return out;
}

// Two effects, cut at the last keyframe within 65535 ticks, are two temporal units, the second one tick longer than
// what its keyframes span.
TEST(FormatHmpg, AVibrationIsInTemporalUnits) {
  const std::string bytes = format_hmpg(long_vibration());
  const std::size_t first_data = 3 + (109 + 66 * 24 + 7) / 8, second_data = 3 + (109 + 36 * 24 + 7) / 8;
  const std::string first = unit(1, 65000, first_data), second = unit(1, 35001, second_data);
  const std::size_t at = bytes.size() - 9 - second_data;
  EXPECT_EQ(bytes.substr(at, 9), second);
  EXPECT_EQ(bytes.substr(at - first_data - 9, 9), first);
  // The nominal duration and how much shorter a unit may be.
  EXPECT_EQ(bytes.substr(9 + 3, 15), bytes_of({{0, 32}, {8000, 32}, {65000, 24}, {29999, 24}, {0, 1}}));
  const HapticExperience read = parse_hmpg(bytes, "long.hmpg");
  const auto& frames = read.perceptions.at(0).channels.at(0).keyframes;
  ASSERT_EQ(frames.size(), 101u);  // the keyframe that both effects have is one again
  for (int i = 0; i <= 100; ++i) {
    EXPECT_EQ(frames[static_cast<std::size_t>(i)].position, 1000 * i);
    EXPECT_NEAR(frames[static_cast<std::size_t>(i)].amplitude, std::sin(0.1 * i), 1.0 / 255.0 + 1e-12);
  }
}

double value_of(const json& perception, const json& channel, const json& frame) {
  return channel.at("gain").get<double>() * frame.at("amplitude_modulation").get<double>() *
         std::pow(10.0, perception.at("perception_unit_exponent").get<int>());
}

// Of the same scene, what HMPG holds is what HJIF holds, but for 8 bits of an amplitude and 32 of a gain.
TEST(ExportHmpg, IsHjifWithinTheStepsOfTheBinaryForm) {
  const Scene scene = painted_scene();
  const json whole = json::parse(exported(scene, ExportFormat::kHjif).at("cosine.hjif"));
  const HapticExperience read = parse_hmpg(exported(scene, ExportFormat::kHmpg).at("cosine.hmpg"), "cosine.hmpg");
  const json back = json::parse(format_hjif(read));
  for (const char* key : {"version", "profile", "level", "date", "description", "timescale"})
    EXPECT_EQ(back.at(key), whole.at(key)) << key;
  ASSERT_EQ(back.at("perceptions").size(), 3u);
  for (std::size_t p = 0; p < 3; ++p) {
    const json &before = whole.at("perceptions")[p], &after = back.at("perceptions")[p];
    for (const char* key : {"perception_modality", "description", "unit_exponent"})
      EXPECT_EQ(after.at(key), before.at(key)) << key;
    const json &channel = before.at("channels")[0], &read_channel = after.at("channels")[0];
    const double gain = std::abs(channel.at("gain").get<double>());
    const double gain_back = read_channel.at("gain").get<double>();
    EXPECT_GT(gain_back, 10.0);
    EXPECT_LE(gain_back, 10000.0);
    const json &band = channel.at("bands")[0], &read_band = read_channel.at("bands")[0];
    EXPECT_EQ(read_band.at("upper_frequency_limit"), band.at("upper_frequency_limit"));
    ASSERT_EQ(read_band.at("effects").size(), band.at("effects").size());
    const json &frames = band.at("effects")[0].at("keyframes"),
               &read_frames = read_band.at("effects")[0].at("keyframes");
    ASSERT_EQ(read_frames.size(), frames.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(read_frames[i].at("relative_position"), frames[i].at("relative_position"));
      worst = std::max(worst,
                       std::abs(value_of(after, read_channel, read_frames[i]) - value_of(before, channel, frames[i])));
    }
    // Half a step of 2/255, and half one of 20000/(2³² − 1) at a gain of at least 10.
    EXPECT_LE(worst, gain * (1.0 / 255.0 + 3e-7));
    if (before.at("perception_modality") == "Friction") {
      EXPECT_LE(worst, 3e-7 * gain);  // amplitude 1 is a code
    }
  }
}

TEST(ExportHmpg, StatesTheLossOfItsBits) {
  const ExportResult result = export_scene(painted_scene(), ExportFormat::kHmpg);
  std::string messages;
  for (const Problem& problem : result.problems) {
    EXPECT_EQ(problem.kind, "not_exported");
    messages += problem.message + "\n";
  }
  // 0.1 mm and 0.4 N: at most 0.39 µm, and 1.57 mN at a force of 0
  EXPECT_THAT(messages, HasSubstr("cosine: forces to better than 0.00157 N; HMPG has 8 bits for a value"));
  EXPECT_THAT(messages, testing::ContainsRegex("cosine: heights to better than 0.3[0-9]* µm; HMPG"));
  EXPECT_THAT(messages, testing::Not(HasSubstr("friction")));
}

TEST(FormatHmpg, ChoosesTheExponentOfTheValuesByTheirSize) {
  HapticExperience experience = small_texture();
  for (const double gain : {3e-9, 1e-6, 0.25, 9999.0, 4e7, -3e-4}) {
    experience.perceptions[0].channels[0].gain = gain;
    const HapticExperience read = parse_hmpg(format_hmpg(experience), "x");
    const double back =
        read.perceptions[0].channels[0].gain * std::pow(10.0, read.perceptions[0].perception_unit_exponent);
    EXPECT_NEAR(back, gain, 3e-7 * std::abs(gain)) << gain;
    EXPECT_LE(hmpg_value_error(experience.perceptions[0], experience.perceptions[0].channels[0]),
              3e-7 * std::abs(gain));  // its amplitudes are codes
  }
}

TEST(FormatHmpg, RefusesWhatItCannotHold) {
  HapticExperience experience = small_texture();
  experience.perceptions[0].channels[0].gain = 1e200;
  EXPECT_THROW(format_hmpg(experience), Error);
  experience = small_texture();
  experience.perceptions[0].channels.resize(257, experience.perceptions[0].channels[0]);
  EXPECT_THROW(format_hmpg(experience), Error);
  experience = small_texture();
  auto& frames = experience.perceptions[0].channels[0].keyframes;
  while (frames.back().position <= 16777215 + 65535) frames.push_back({frames.back().position + 60000, 0.0});
  EXPECT_THROW(format_hmpg(experience), Error);
  EXPECT_THROW(format_hmpg({}), Error);
  experience = long_vibration();
  experience.perceptions.push_back(experience.perceptions[0]);
  EXPECT_NO_THROW(format_hmpg(experience));  // their effects begin together
  experience.perceptions[1].channels[0].keyframes.erase(experience.perceptions[1].channels[0].keyframes.begin() + 65);
  EXPECT_THROW(format_hmpg(experience), Error);
}

std::string refusal_of(const std::string& bytes) {
  try {
    parse_hmpg(bytes, "bad.hmpg");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ParseHmpg, RefusesEveryFileThatEndsEarly) {
  const std::string whole = format_hmpg(small_texture());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    if (size == 9 + 103) continue;  // the metadata alone: a channel without keyframes
    EXPECT_THAT(refusal_of(whole.substr(0, size)),
                testing::AnyOf(HasSubstr("ends early"), HasSubstr("the initialization unit is missing")))
        << size;
  }
  EXPECT_THAT(refusal_of(whole.substr(0, 9 + 103)), HasSubstr("bad.hmpg: HMPG: the channel 'c' has no keyframes"));
}

TEST(ParseHmpg, NamesWhatItDoesNotRead) {
  const std::string whole = format_hmpg(small_texture());
  EXPECT_THAT(refusal_of("{\"version\": \"2023\"}"), HasSubstr("bad.hmpg: HMPG: a unit of type"));
  EXPECT_THAT(refusal_of(whole.substr(9 + 103)), HasSubstr("the first unit is not an initialization unit"));
  const auto changed = [&whole](std::size_t byte, int value) {
    std::string out = whole;
    out[byte] = static_cast<char>(value);
    return refusal_of(out);
  };
  const std::size_t experience = 9 + 18, perception = experience + 23, channel = perception + 17, band = channel + 30;
  EXPECT_THAT(changed(experience + 22, 1), HasSubstr("avatars cannot be read"));
  EXPECT_THAT(changed(perception + 3 + 4, 5), HasSubstr("perceptions of modality 5 cannot be read"));
  EXPECT_THAT(changed(channel + 3 + 6, 1), HasSubstr("reference devices cannot be read"));
  EXPECT_THAT(changed(channel + 3 + 11, 1), HasSubstr("mixing weights other than 1"));
  EXPECT_THAT(changed(band + 3 + 5, 0x44), HasSubstr("bands other than curves"));
  EXPECT_THAT(changed(band + 3, 7), HasSubstr("data of a band that is not given"));
  EXPECT_THAT(changed(9, 12 << 2), HasSubstr("does not begin with its timing"));
  EXPECT_THAT(changed(9 + 103, 1 << 2), HasSubstr("the other kind"));
  EXPECT_THAT(changed(9 + 3 + 4, 1), HasSubstr("a timescale of"));
}

// A stream may cut an effect where a unit ends: it continues in a dependent unit, its position before that unit's
// begin. A silent unit is time without effects. Units of 100, 10 and 100 ticks, effects from 0 and from 150.
TEST(ParseHmpg, JoinsAnEffectThatContinuesInALaterUnit) {
  HapticExperience begin = long_vibration();
  begin.perceptions[0].channels[0].keyframes = {{0, -1.0}, {50, 1.0}};
  const std::string whole = format_hmpg(begin);
  const auto data = [](int dependent, std::int64_t position, std::vector<Field> frames) {
    std::vector<Field> fields{{dependent, 1}, {0, 8},
                              {0, 16},        {0, 8},
                              {1, 16},        {0, 16},
                              {0, 2},         {static_cast<std::uint64_t>(position) & 0x1ffffff, 25},
                              {0, 1},         {frames.size() / 2, 16}};
    fields.insert(fields.end(), frames.begin(), frames.end());
    const std::string payload = bytes_of(fields);
    return packet(5, payload.size()) + payload;
  };
  const std::string first = data(0, 0, {{0, 8}, {0, 16}, {255, 8}, {50, 16}});
  const std::string later = data(1, -110, {{0, 8}, {120, 16}}) + data(0, 40, {{255, 8}, {5, 16}});
  const std::string metadata = whole.substr(0, whole.size() - 9 - first.size());
  const HapticExperience read = parse_hmpg(
      metadata + unit(1, 100, first.size()) + first + unit(3, 10, 0) + unit(1, 100, later.size()) + later, "x");
  std::vector<std::pair<std::int64_t, double>> frames;
  for (const HapticKeyframe& frame : read.perceptions.at(0).channels.at(0).keyframes)
    frames.emplace_back(frame.position, frame.amplitude);
  EXPECT_THAT(frames, testing::ElementsAre(testing::Pair(0, -1.0), testing::Pair(50, 1.0), testing::Pair(120, -1.0),
                                           testing::Pair(155, 1.0)));
}

// The same initialization unit again, as a stream repeats it, changes nothing; another one is refused.
TEST(ParseHmpg, ReadsARepeatedInitialization) {
  const std::string whole = format_hmpg(small_texture()), metadata = whole.substr(0, 9 + 103);
  EXPECT_EQ(format_hjif(parse_hmpg(metadata + whole, "x")), format_hjif(parse_hmpg(whole, "x")));
  std::string other = metadata;
  other.back() = static_cast<char>(other.back() ^ 0x10);
  EXPECT_THAT(refusal_of(other + whole), HasSubstr("a second initialization unit has other metadata"));
}

// Whatever the damage, an Error or an experience that can be written again.
TEST(ParseHmpg, DamageIsAnError) {
  std::mt19937 random(7);
  const std::string whole = format_hmpg(long_vibration());
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = whole;
    for (int change = 0; change < 3; ++change) bytes[random() % 180] = static_cast<char>(random() % 256);
    try {
      const HapticExperience read = parse_hmpg(bytes, "x");
      EXPECT_FALSE(read.perceptions.empty());
      format_hjif(read);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "");
    }
  }
}

}  // namespace
}  // namespace asperity
