// SMD by its public descriptions: the writers of VisualSR2D and of BEV's profile converter, and a reader in Python.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/surface/parse_surface_file.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace std::string_literals;

// h = 1.5 µm sin(i), 100 points 0.5 µm apart, as the writers do.
std::string smd(const std::string& cx = "CX\0 I\0 100 mm\0 1.0e0 D\0 5.0e-4\r\n"s,
                const std::string& cz = "CZ\0 A\0 100 um\0 1.0e0 D\0\r\n"s) {
  std::string out = "ISO 5436-2:2001\0test\0\r\nPRF\0 0 ISO5436\0\r\n"s + cx + cz +
                    "\x03\r\n"
                    "DATE 1-January-2020\0\r\nCOMMENT /* a sine */\0\r\n\x03\r\n"s;
  for (int i = 0; i < 100; ++i) out += std::to_string(1.5 * std::sin(i)) + "\r\n";
  out += "\x03\r\n";
  unsigned sum = 0;
  for (const char c : out) sum += static_cast<unsigned char>(c);
  return out + std::to_string(sum % 65535) + "\r\n\x03\r\n\x1a\r\n";
}

TEST(ParseSmd, HasHeightsAndSpacing) {
  const auto file = parse_surface_file(smd(), "s.smd");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->format, "SMD");
  ASSERT_TRUE(file->is_profile());
  EXPECT_NEAR(file->map.x_spacing_m, 5e-7, 1e-18);
  ASSERT_EQ(file->map.height_m.size(), 100u);
  for (int i = 0; i < 100; ++i)
    EXPECT_NEAR(file->map.height_m[static_cast<std::size_t>(i)], 1.5e-6 * std::sin(i), 0.5e-12);  // six decimals
}

TEST(ParseSmd, TakesUnitsAndScales) {
  const auto file =
      parse_surface_file(smd("CX I 100 um 2.0E+000 D 5.0E-001\r\n", "CZ A 100 nm 1.0E+003 D\r\n"), "s.smd");
  ASSERT_TRUE(file);
  EXPECT_NEAR(file->map.x_spacing_m, 1e-6, 1e-18);
  EXPECT_NEAR(file->map.height_m[1], 1.5e-6 * std::sin(1.0), 1e-12);
}

TEST(ParseSmd, NamesWhatIsWrong) {
  const auto refuses = [](const std::string& bytes, const char* part) {
    EXPECT_THAT([&] { parse_surface_file(bytes, "s.smd"); }, ThrowsMessage<Error>(HasSubstr(part)));
  };
  refuses(smd("CX\0 I\0 100 V\0 1.0e0 D\0 5.0e-4\r\n"s), "'V'");
  refuses(smd("CX\0 I\0 100 mm\0 1.0e0 D\0 0\r\n"s), "spacing");
  refuses(smd("CX\0 A\0 100 mm\0 1.0e0 D\0\r\n"s), "type 'A'");
  refuses(smd("CX\0 I\0 99 mm\0 1.0e0 D\0 5.0e-4\r\n"s), "99 points");
  refuses(smd("CX\0 I\0 101 mm\0 1.0e0 D\0 5.0e-4\r\n"s, "CZ\0 A\0 101 um\0 1.0e0 D\0\r\n"s), "100 heights where 101");
  refuses(smd("CX\0 I\0 99999999 mm\0 1.0e0 D\0 5.0e-4\r\n"s, "CZ\0 A\0 99999999 um\0 1.0e0 D\0\r\n"s), "do not fit");
  refuses(smd("", "CZ\0 A\0 100 um\0 1.0e0 D\0\r\n"s), "no line CX");
  std::string bad = smd();
  bad.replace(bad.find("1.262206"), 8, "1.26x206");
  refuses(bad, "'1.26x206'");
  std::string areal = smd();
  areal.replace(areal.find("PRF"), 3, "SUR");
  refuses(areal, "'SUR'");
}

TEST(ParseSmd, TheSumOfItsBytesIsCompared) {
  EXPECT_TRUE(parse_surface_file(smd(), "s.smd")->problems.empty());
  std::string changed = smd();
  changed.replace(changed.find("1.262206"), 8, "1.262207");  // one more in the sum
  const Problems problems = parse_surface_file(changed, "s.smd")->problems;
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].kind, "checksum");
  EXPECT_THAT(problems[0].message,
              testing::MatchesRegex("s.smd: the sum of its bytes is [0-9]+ .*it states [0-9]+: .*"));
  const std::string without = smd().substr(0, smd().rfind('\x03', smd().rfind('\x03') - 1) + 1);
  EXPECT_TRUE(parse_surface_file(without, "s.smd")->problems.empty()) << "no sum is stated";
}

// Cut anywhere before the end of the heights it is refused, or not known for one.
TEST(ParseSmd, IsNotReadCut) {
  const std::string whole = smd();
  const std::size_t heights_end = whole.find('\x03', whole.find('\x03', whole.find('\x03') + 1) + 1);
  for (std::size_t size = 0; size <= heights_end; ++size) {
    try {
      EXPECT_FALSE(parse_surface_file(whole.substr(0, size), "cut.smd")) << size;
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace asperity
