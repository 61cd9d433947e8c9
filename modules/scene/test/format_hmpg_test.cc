// HMPG, the binary form: the bytes that the layout in format_hmpg.h states, and what a scene's export keeps in them.
#include <cmath>
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
#include "hmpg_bytes.h"
#include "painted_scene.h"

namespace asperity {
namespace {

using nlohmann::json;
using testing::HasSubstr;

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
  EXPECT_THAT(messages, HasSubstr("cosine: forces to about 0.00157 N; HMPG has 8 bits for a value"));
  EXPECT_THAT(messages, testing::ContainsRegex("cosine: heights to about 0.3[0-9]* µm; HMPG"));
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

}  // namespace
}  // namespace asperity
