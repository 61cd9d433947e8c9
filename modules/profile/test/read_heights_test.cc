#include "asperity/profile/read_heights.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

HeightProfile profile_of(std::string_view text, const ReadHeightsConfig& config = {}) {
  return std::get<HeightProfile>(parse_heights(text, "f.csv", config));
}

ArealMap map_of(std::string_view text) { return std::get<ArealMap>(parse_heights(text, "f.txt")); }

void expect_error(std::string_view text, const std::string& message, const ReadHeightsConfig& config = {}) {
  EXPECT_THAT([&] { parse_heights(text, "f.csv", config); }, ThrowsMessage<Error>(HasSubstr(message))) << text;
}

TEST(ReadHeights, OneColumn) {
  const ReadHeightsConfig half_um{.spacing_m = 0.5e-6};
  const HeightProfile with_header = profile_of("height\n1\n-2.5\nnan\n", half_um);
  ASSERT_EQ(with_header.height_m.size(), 3u);
  EXPECT_DOUBLE_EQ(with_header.height_m[1], -2.5e-6);
  EXPECT_TRUE(std::isnan(with_header.height_m[2]));
  EXPECT_EQ(with_header.spacing_m, 0.5e-6);
  EXPECT_EQ(with_header.column, "height");
  EXPECT_DOUBLE_EQ(profile_of("1\r\n2\r\n3", half_um).height_m[2], 3e-6);
  EXPECT_EQ(profile_of("height_m\n1\n2\n", half_um).height_m[1], 2.0);
  EXPECT_DOUBLE_EQ(profile_of("height_mm\n1\n2\n", half_um).height_m[1], 2e-3);
  EXPECT_DOUBLE_EQ(profile_of("z_µm\n1\n2\n", half_um).height_m[1], 2e-6);
  EXPECT_DOUBLE_EQ(profile_of("height\n1\n2\n", {.spacing_m = 1e-6, .unit = HeightUnit::kNanometre}).height_m[1], 2e-9);
}

TEST(ReadHeights, OurOwnProfile) {
  const std::string text = "s_m,height_m,sigma_m,texture_m\n0.1,1,0,5\n0.100025,2,0,6\n0.10005,nan,0,nan\n";
  const HeightProfile profile = profile_of(text);
  EXPECT_EQ(profile.column, "texture_m");
  EXPECT_EQ(profile.height_m[1], 6.0);
  EXPECT_NEAR(profile.spacing_m, 25e-6, 1e-12);
  EXPECT_EQ(profile_of(text, {.column = "height_m"}).height_m[1], 2.0);
  EXPECT_EQ(profile_of("s_m,height_m\n0,1\n1,2\n").column, "height_m");
}

// A TIFF of 3 x 2 floats, by the specification; nan in the middle.
std::string tiff() {
  std::string out("II*\0\x08\0\0\0", 8);
  const auto put = [&out](std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
  };
  const std::uint32_t fields[][3] = {{256, 4, 3},   {257, 4, 2}, {258, 3, 32}, {259, 3, 1},  {262, 3, 1},
                                     {273, 4, 134}, {277, 3, 1}, {278, 4, 2},  {279, 4, 24}, {339, 3, 3}};
  put(10, 2);
  for (const auto& [tag, type, value] : fields) {
    put(tag, 2);
    put(type, 2);
    put(1, 4);
    put(value, 4);
  }
  put(0, 4);
  for (const float value : {1.5F, std::nanf(""), -2.0F, 0.0F, 0.25F, 3.0F}) put(std::bit_cast<std::uint32_t>(value), 4);
  return out;
}

TEST(ReadHeights, TiffAtTheSpacingAndUnitGiven) {
  const auto map = std::get<ArealMap>(parse_heights(tiff(), "t.tif", {.spacing_m = 2e-6}));
  EXPECT_EQ(map.columns, 3u);
  EXPECT_EQ(map.rows, 2u);
  EXPECT_EQ(map.x_spacing_m, 2e-6);
  EXPECT_EQ(map.y_spacing_m, 2e-6);
  EXPECT_NEAR(map.height_m[0], 1.5e-6, 1e-18);
  EXPECT_TRUE(std::isnan(map.height_m[1]));
  EXPECT_NEAR(map.height_m[5], 3e-6, 1e-18);
  const auto in_mm =
      std::get<ArealMap>(parse_heights(tiff(), "t.tif", {.spacing_m = 2e-6, .unit = HeightUnit::kMillimetre}));
  EXPECT_NEAR(in_mm.height_m[0], 1.5e-3, 1e-15);
  expect_error(tiff(), "states no spacing");
}

TEST(ReadHeights, ArealMapInEitherOrder) {
  const ArealMap along_x =
      map_of("0.0000,0.0000,1\n0.0050,0,2\n0.0100,0,3\n\n\n0,0.002,4\n0.005,0.002,5\n0.01,0.002,nan\n");
  EXPECT_EQ(along_x.columns, 3u);
  EXPECT_EQ(along_x.rows, 2u);
  EXPECT_NEAR(along_x.x_spacing_m, 5e-6, 1e-15);
  EXPECT_NEAR(along_x.y_spacing_m, 2e-6, 1e-15);
  EXPECT_DOUBLE_EQ(along_x.at(1, 1), 5e-6);
  EXPECT_TRUE(std::isnan(along_x.at(1, 2)));
  const ArealMap along_y =
      map_of("x_mm,y_mm,z_um\n0,0,1\n0,0.002,4\n0.005,0,2\n0.005,0.002,5\n0.01,0,3\n0.01,0.002,6\n");
  EXPECT_EQ(along_y.columns, 3u);
  EXPECT_EQ(along_y.rows, 2u);
  EXPECT_NEAR(along_y.x_spacing_m, 5e-6, 1e-15);
  EXPECT_DOUBLE_EQ(along_y.at(1, 1), 5e-6);
  EXPECT_DOUBLE_EQ(along_y.at(0, 2), 3e-6);
}

TEST(ReadHeights, ArealErrorsNameTheLine) {
  expect_error("0,0,1\n1,0,2\n0,1,3\n", "f.csv:3: the last row has 1 points where the first has 2");
  expect_error("0,0,1\n1,0,2\n3,0,3\n", "f.csv:3: the point (0.003, 0) m is not the grid's next");
  expect_error("0,0,1\n1,0,2\n2,0,3\n0,1,3\n1,1,3\n2,0,3\n", "f.csv:6: the point (0.002, 0) m");
  expect_error("0,0,1\n1,0,2\n0,1,3\n1,1,x\n", "f.csv:4: column 3: 'x' is not a number");
  expect_error("0,0,1\n1,0,2\n0,1,inf\n", "f.csv:3: column 3: 'inf' is infinite");
  expect_error("0,0,1\n1,0,2\n0,1\n", "f.csv:3: 2 cells where the first line has 3");
  expect_error("0,0,1\n1,0,2\nnan,1,3\n", "f.csv:3: the position is not a number");
  expect_error("0,0,1\n0,0,2\n", "f.csv:2: the second point is not the next along x or y");
  expect_error("0,0,1\n1,0,2\n0,0,3\n1,0,2\n", "f.csv:3: the second row does not follow the first");
  expect_error("0,0,1\n1,0,2\n2,0,3\n", "f.csv:3: an areal map has at least 2 by 2 points");
  expect_error("0,0,1\n", "f.csv:1: an areal map has at least 2 by 2 points");
}

TEST(ReadHeights, ProfileErrorsNameTheLine) {
  expect_error("", "f.csv:1: the file is empty");
  expect_error("height\n1\n2\n", "the spacing of its heights must be given");
  const ReadHeightsConfig one_um{.spacing_m = 1e-6};
  expect_error("height\n1\n", "f.csv:2: fewer than two heights", one_um);
  expect_error("height\n1\nabc\n", "f.csv:3: column 'height': 'abc' is not a number", one_um);
  expect_error("a,b\n1,2\n", "one must be chosen by name", one_um);
  expect_error("a,b\n1,2\n", "f.csv:1: column 'c' is missing", {.spacing_m = 1e-6, .column = "c"});
  expect_error("a,a\n1,2\n", "f.csv:1: column 'a' appears twice", one_um);
  expect_error("s_m,height_m\n0,1\n1,2\n2,", "its last row may be cut off");
  expect_error("s_m,height_m\n0,1\n1,2\n3,3\n", "s_m is not uniform: row 2 has 1 where 1.5 was expected");
  expect_error("s_m,height_m\n0,1\nnan,2\n2,3\n", "s_m is not uniform: row 2 has nan");
  expect_error("s_m,height_m\n0,1\n1,2\n", "a spacing of 1e-06 m is given, but s_m has 1", one_um);
}

TEST(ReadHeights, TablesOfStylusInstruments) {
  const auto profile_of = [](const std::string& text, const ReadHeightsConfig& config = {}) {
    return std::get<HeightProfile>(parse_heights(text, "f.csv", config));
  };
  const std::string german =
      "\xef\xbb\xbf"
      "Ger\xc3\xa4t;Rauheit 1\r\nDatum;22.11.2026\r\nWeg;H\xc3\xb6he\r\nmm;\xc2\xb5m\r\n"
      "0,000;1,5\r\n0,001;-0,25\r\n0,002;\r\n0,003;2\r\n\r\n";
  const HeightProfile profile = profile_of(german);
  EXPECT_NEAR(profile.spacing_m, 1e-6, 1e-18);
  ASSERT_EQ(profile.height_m.size(), 4u);
  EXPECT_DOUBLE_EQ(profile.height_m[0], 1.5e-6);
  EXPECT_DOUBLE_EQ(profile.height_m[1], -0.25e-6);
  EXPECT_TRUE(std::isnan(profile.height_m[2]));
  EXPECT_DOUBLE_EQ(profile_of("X (mm)\tZ (um)\n0\t1\n0.5\t2e0\n1\t3\n").height_m[2], 3e-6);
  EXPECT_DOUBLE_EQ(profile_of("x_mm,z_um\n0,1\n0.5,2\n1,3\n").spacing_m, 0.5e-3);
  EXPECT_DOUBLE_EQ(profile_of("a;b\nz [nm]\n7,5\n8\n", {.spacing_m = 1e-6}).height_m[0], 7.5e-9);
  const auto map = std::get<ArealMap>(
      parse_heights("x [mm];y [mm];z [\xc2\xb5m]\n0;0;1\n1;0;2\n2;0;\n0;0,5;4\n1;0,5;5\n2;0,5;6\n", "f.csv"));
  EXPECT_EQ(map.columns, 3u);
  EXPECT_DOUBLE_EQ(map.y_spacing_m, 0.5e-3);
  EXPECT_TRUE(std::isnan(map.height_m[2]));
  EXPECT_DOUBLE_EQ(map.height_m[5], 6e-6);

  expect_error("weg;z\n0;1\n1;2\n", "f.csv:2: no header line states the units of its 2 columns");
  expect_error("x [mm];z [um]\n0;1\n1;2\n2.5;2\n", "f.csv:4: its positions are not even: 0.0025 m is 0.0015 m after");
  expect_error("x [mm];z [um]\n0;1\n1;2\n1;2\n", "f.csv:4: its positions do not rise");
  expect_error("x [mm];z [um]\n0;1\n1;2\nend of data\n", "f.csv:4: 'end of data' is not a row of 2 numbers");
  expect_error("x [mm];z [um]\n0;1\n1;1e12\n", "f.csv:3: '1;1e12' is more than ten metres");
  expect_error("x [mm];y [mm];z [um]\n0;0;1\n1;0;2\n0;1;1\n", "its end was cut off");
  expect_error("x [mm];z [um]\n0;1\n1;2\n2;2", "f.csv:4: the file does not end in a newline");
  // A damaged number is not a missing height; the words for one are.
  expect_error("x [mm];z [um]\n0;1\n1;?.5\n", "f.csv:3: '1;?.5' is not a row of 2 numbers");
  for (const char* word : {"", "NaN", "BAD", "***", "---", "\"No Data\""}) {
    const HeightProfile gap = profile_of(std::string("x [mm];z [um]\n0;1\n1;") + word + "\n2;3\n");
    ASSERT_EQ(gap.height_m.size(), 3u) << word;
    EXPECT_TRUE(std::isnan(gap.height_m[1])) << word;
  }
}

TEST(ReadHeights, TablesWithCommasAndBlanks) {
  for (const char* head : {"X [mm],Z [\xc2\xb5m]\n", "Position (mm),Height (um)\n", "Scan 7\nx,z\nmm,um\n"}) {
    const HeightProfile profile = profile_of(std::string(head) + "0.0,1.5\n0.5,-2\n1.0,3\n");
    EXPECT_DOUBLE_EQ(profile.spacing_m, 0.5e-3) << head;
    EXPECT_DOUBLE_EQ(profile.height_m[1], -2e-6) << head;
  }
  const HeightProfile blanks = profile_of("# x[mm]  z[nm]\n0.0   1.5\n 0.5  -2\n1.0\t3\n");
  EXPECT_DOUBLE_EQ(blanks.height_m[2], 3e-9);
  // Without units they are stated; a number's unit in a header line is not the columns'.
  expect_error("length 4.8 mm step 0.5 um\n0 1\n1 2\n", "f.csv:2: no header line states the units of its 2 columns");
  expect_error("0 1\n1 2\n", "--set input.units=mm,um states them");
  expect_error("0 1\n1 2\n", "'mm' does not state the units of its 2 columns", {.units = "mm"});
  EXPECT_DOUBLE_EQ(profile_of("0 1\n1 2\n", {.units = "mm,um"}).height_m[1], 2e-6);
}

TEST(ReadHeights, OneColumnInItsHeadersUnitOrWithDecimalCommas) {
  const ReadHeightsConfig one_um{.spacing_m = 1e-6};
  EXPECT_DOUBLE_EQ(profile_of("Height (nm)\n1.5\n2\n", one_um).height_m[0], 1.5e-9);
  EXPECT_DOUBLE_EQ(profile_of("-0,25\n1,5\n2\n", one_um).height_m[0], -0.25e-6);
  EXPECT_DOUBLE_EQ(profile_of("Profil\n-0,25\n1,5\n", one_um).height_m[1], 1.5e-6);
}

TEST(ReadHeights, TextInUtf16) {
  std::string utf16 = "\xff\xfe";
  for (const char c : std::string("x [mm]\tz [um]\n0\t1\n1\t2\n")) utf16 += {c, '\0'};
  EXPECT_DOUBLE_EQ(profile_of(utf16).height_m[1], 2e-6);
}

TEST(ReadHeights, PicturesAreSentToTheirOption) {
  expect_error(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), "feel --height-maps takes it");
  expect_error("\xff\xd8\xff\xe0", "states neither the spacing nor the range");
}

TEST(ReadHeights, RowsThatWereLeftOutAreMissing) {
  const HeightProfile profile = profile_of("x [mm];z [um]\n0;1\n0,5;2\n1,5;4\n2;5\n");
  ASSERT_EQ(profile.height_m.size(), 5u);
  EXPECT_TRUE(std::isnan(profile.height_m[2]));
  EXPECT_DOUBLE_EQ(profile.height_m[3], 4e-6);

  // Points of a map in any order, one left out, the corner too: a map, not a file that was cut.
  const std::string points[] = {"2 1 6", "0 0 1", "2 0 3", "1 2 8", "0 1 4", "1 0 2", "0 2 7"};
  for (const char* head : {"x[mm] y[mm] z[um]\n", "x_mm,y_mm,z_um\n"}) {
    std::string text = head;
    for (std::string point : points) {
      if (text.find(',') != std::string::npos) std::replace(point.begin(), point.end(), ' ', ',');
      text += point + "\n";
    }
    const ArealMap map = map_of(text);
    ASSERT_EQ(map.columns, 3u) << head;
    ASSERT_EQ(map.rows, 3u) << head;
    for (std::size_t i = 0; i < 9; ++i) {
      if (i == 4 || i == 8) {
        EXPECT_TRUE(std::isnan(map.height_m[i])) << head << i;
      } else {
        EXPECT_DOUBLE_EQ(map.height_m[i], 1e-6 * static_cast<double>(i + 1)) << head << i;
      }
    }
    expect_error(text + points[0] + "\n", head[1] == '_' ? "" : "each once");
  }
}

TEST(ReadHeights, HeightsFarAboveTheLengthHaveAnotherUnit) {
  std::string text = "x [mm];z [m]\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(i) + (i % 2 == 0 ? ";0\n" : ";2,5\n");
  expect_error(text, "heights span 2.5 m over a length of 0.02 m");
}

// 2455.245 of the column's unit, which the header states.
TEST(ReadHeights, TheChosenColumnsUnitIsUsed) {
  struct Case {
    const char* header;
    double metres;
  };
  for (const Case& one : {Case{"Height (nm)", 1e-9},
                          {"Height [nm]", 1e-9},
                          {"HEIGHT_NM", 1e-9},
                          {"Height mm", 1e-3},
                          {"z (\xc3\x85)", 1e-10},
                          {"z_mil", 2.54e-5},
                          {"z [inch]", 0.0254}}) {
    HeightsOrigin origin;
    const ReadHeightsConfig chosen{.spacing_m = 1e-3, .column = one.header};
    const std::string several = std::string("No.,Position (mm),") + one.header + "\n0,0.0,0.25\n1,0.001,0.5\n";
    const auto of_three = std::get<HeightProfile>(parse_heights(several, "f.csv", chosen, nullptr, &origin));
    EXPECT_DOUBLE_EQ(of_three.height_m[0], 0.25 * one.metres) << one.header;
    EXPECT_EQ(origin.units.height.origin, UnitOrigin::kHeader) << one.header;
    EXPECT_DOUBLE_EQ(origin.units.height.metres, one.metres) << one.header;
    const HeightProfile alone = profile_of(std::string(one.header) + "\n0.25\n0.5\n", {.spacing_m = 1e-3});
    EXPECT_DOUBLE_EQ(alone.height_m[1], 0.5 * one.metres) << one.header;
  }
}

TEST(ReadHeights, AUnitThatIsNotALengthIsRefusedWithItsColumn) {
  const ReadHeightsConfig one_um{.spacing_m = 1e-6};
  expect_error("z (V)\n1\n2\n", "f.csv:1: column 'z (V)': its unit 'V' is not a length", one_um);
  expect_error("z_V\n1\n2\n", "column 'z_V': its unit 'V' is not a length", one_um);
  expect_error("n,z [counts]\n0,1\n1,2\n", "column 'z [counts]': its unit 'counts'",
               {.spacing_m = 1e-6, .column = "z [counts]"});
  expect_error("x [mm];z [V]\n0;1\n0,1;2\n", "column 'z [V]': its unit 'V' is not a length");
  // A name in brackets that is not a unit: the setting states one.
  EXPECT_DOUBLE_EQ(profile_of("z (raw)\n1\n2\n", {.spacing_m = 1e-6, .units = "nm"}).height_m[1], 2e-9);
}

TEST(ReadHeights, StatesWhereTheUnitsComeFrom) {
  const auto origin_of = [](std::string_view text, const ReadHeightsConfig& config) {
    HeightsOrigin origin;
    parse_heights(text, "f.csv", config, nullptr, &origin);
    return units_text(origin.units);
  };
  EXPECT_THAT(origin_of("1\n2\n3\n", {.spacing_m = 1e-6}), HasSubstr("heights in µm (assumed)"));
  EXPECT_EQ(origin_of("1\n2\n3\n", {.spacing_m = 1e-6, .unit = HeightUnit::kNanometre}), "heights in nm (as set)");
  EXPECT_THAT(
      origin_of("0,0,1\n1,0,2\n0,1,3\n1,1,4\n", {}),
      testing::AllOf(HasSubstr("heights in µm (assumed), positions in mm (assumed)"), HasSubstr("input.units")));
  EXPECT_EQ(origin_of("0,0,1\n1,0,2\n0,1,3\n1,1,4\n", {.units = "um,um,nm"}),
            "heights in nm (as set), positions in µm (as set)");
  EXPECT_EQ(origin_of("x_mm,z_um\n0,1\n1,2\n2,3\n", {}),
            "heights in µm (by the header), positions in mm (by the header)");
  EXPECT_EQ(origin_of("x [mm];z [nm]\n0;1\n1;2\n2;3\n", {}),
            "heights in nm (by the header), positions in mm (by the header)");
  EXPECT_EQ(origin_of("s_m,height_m\n0,1\n1,2\n", {}), "heights in m (the file's), positions in m (the file's)");
}

TEST(ReadHeights, TablesWithCommas) {
  const HeightProfile gaps = profile_of("x_mm,z_um\n0,1\n1,\n2,NA\n3,4\n");
  ASSERT_EQ(gaps.height_m.size(), 4u);
  EXPECT_TRUE(std::isnan(gaps.height_m[1]));
  EXPECT_TRUE(std::isnan(gaps.height_m[2]));
  EXPECT_DOUBLE_EQ(gaps.height_m[3], 4e-6);
  const HeightProfile turned = profile_of("z_um,x_mm\n5,0\n6,2\n7,4\n");
  EXPECT_DOUBLE_EQ(turned.spacing_m, 2e-3);
  EXPECT_DOUBLE_EQ(turned.height_m[1], 6e-6);
  const HeightProfile quoted =
      profile_of("\"Horizontal\",\"Vertical\"\n\"um\",\"nm\"\n\"0.0\",\"2.5\"\n\"1.0\",\"3.5\"\n\"2.0\",\"4.5\"\n");
  EXPECT_NEAR(quoted.spacing_m, 1e-6, 1e-18);
  EXPECT_DOUBLE_EQ(quoted.height_m[1], 3.5e-9);
  EXPECT_EQ(profile_of("x_mm,z_um\n0,1\n1,2\n2,3\n\x1a").height_m.size(), 3u);
  expect_error("x_mm,z_um\n0,1\n2,2\n1,3\n4,4\n", "f.csv:4: column 'x_mm': the positions do not rise: '1'");
  expect_error("No.,Position (mm),Height (nm)\n0,0,1\n1,1,2\n", "--set input.column=NAME of 'No.', 'Position (mm)'");
}

TEST(ReadHeights, EqualHeightsFarOutsideTheOthersAreNamed) {
  const auto found = [](const char* odd) {
    std::string text;
    for (int i = 0; i < 100; ++i) text += i % 40 == 7 ? std::string(odd) + "\n" : std::to_string(i % 9) + "\n";
    Problems problems;
    parse_heights(text, "f.csv", {.spacing_m = 1e-3}, &problems);
    return problems;
  };
  const Problems sentinel = found("-9999");
  ASSERT_EQ(sentinel.size(), 1u);
  EXPECT_EQ(sentinel[0].kind, "sentinel");
  EXPECT_EQ(sentinel[0].count, 3u);
  EXPECT_EQ(found("9999").size(), 1u);
  EXPECT_TRUE(found("-20").empty());  // a pit
  EXPECT_TRUE(found("nan").empty());
}

// Half of the last digit, in any way of writing numbers: decimals, integers, powers of ten, zeros left out.
TEST(ReadHeights, KnowsTheRoundingOfItsNumbers) {
  const auto rounding_m = [](std::string_view text, const ReadHeightsConfig& config = {.spacing_m = 1e-6}) {
    HeightsOrigin origin;
    parse_heights(text, "f.csv", config, nullptr, &origin);
    return origin.last_digit_rms_m;
  };
  EXPECT_NEAR(rounding_m("1.000\n2.125\n3.000\n"), 0.5e-9, 1e-15);
  EXPECT_NEAR(rounding_m("1\n2.125\n3\n"), 0.5e-9, 1e-15);
  EXPECT_NEAR(rounding_m("z_nm\n12\n7\n9\n"), 0.5e-9, 1e-15);
  EXPECT_NEAR(rounding_m("1.00e+00\n2.13e+00\n3.00e+00\n"), 5e-9, 1e-15);
  EXPECT_NEAR(rounding_m("x [mm];z [\xc2\xb5m]\n0;1,00\n1;2,13\n2;3,00\n"), 5e-9, 1e-15);
  EXPECT_NEAR(rounding_m("0,0,1.5\n1,0,2.5\n0,1,3.5\n1,1,4.5\n"), 0.05e-6, 1e-15);
  // 17 digits: what is left is the doubles' own.
  EXPECT_LT(rounding_m("1.2345678901234567\n2.3456789012345678\n"), 1e-19);
}

}  // namespace
}  // namespace asperity
