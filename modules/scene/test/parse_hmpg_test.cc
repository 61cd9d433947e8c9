// Reading HMPG: from bytes that are put together here, and from damaged ones.
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/scene/format_hjif.h"
#include "asperity/scene/format_hmpg.h"
#include "asperity/scene/parse_hmpg.h"
#include "hmpg_bytes.h"

namespace asperity {
namespace {

using testing::HasSubstr;

std::string refusal_of(const std::string& bytes) {
  try {
    parse_hmpg(bytes, "bad.hmpg");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
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

// A file that lost its last unit has fewer effects than its band states.
TEST(ParseHmpg, AFileWithoutItsLastUnitIsRefused) {
  const std::string whole = format_hmpg(long_vibration());
  std::size_t last = 0, next = 0;
  // Units: a header of 9 bytes that ends with the packets' size in 32 bits and 4 bits more.
  while (next < whole.size()) {
    last = next;
    std::uint64_t header = 0;
    for (std::size_t i = 1; i < 9; ++i) header = (header << 8) | static_cast<unsigned char>(whole[next + i]);
    next += 9 + static_cast<std::size_t>((header >> 4) & 0xffffffffu);
  }
  ASSERT_EQ(next, whole.size());
  ASSERT_GT(last, 9u + 103u);
  EXPECT_THAT(refusal_of(whole.substr(0, last)), HasSubstr("the number of a band's effects is not the stated one"));
}

// Whatever the damage, an Error of this format or an experience.
TEST(ParseHmpg, DamageIsAnError) {
  std::mt19937 random(7);
  const std::string whole = format_hmpg(long_vibration());
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = whole;
    for (int change = 0; change < 3; ++change) bytes[random() % 180] = static_cast<char>(random() % 256);
    try {
      EXPECT_FALSE(parse_hmpg(bytes, "x").perceptions.empty());
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("x: HMPG"));
    }
  }
}

}  // namespace
}  // namespace asperity
