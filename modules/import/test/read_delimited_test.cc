#include "asperity/import/read_delimited.h"

#include <gmock/gmock.h>
#include <cmath>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(const std::string& text) {
  try {
    read_delimited(text, "x.csv");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadDelimited, FindsSeparatorAndDecimalMark) {
  for (const auto& [text, separator, comma] :
       {std::tuple("t,x\n0,1.5\n1,-2e3\n", ',', false), std::tuple("t;x\n0;1,5\n1;-2e3\n", ';', true),
        std::tuple("t\tx\n0\t1.5\n1\t-2e3\n", '\t', false), std::tuple("t x\n0 1,5\n1  -2e3\n", ' ', true),
        std::tuple("t, x\n0, 1.5\n1, -2e3\n", ',', false),
        std::tuple("\"t\",\"x\"\n\"0\",\"1,5\"\n1,-2e3\n", ',', true),
        std::tuple("t;x\r\n0;1.5\r\n1;-2e3\r\n", ';', false)}) {
    const DelimitedTable table = read_delimited(text, "x.csv");
    EXPECT_EQ(table.separator, separator) << text;
    EXPECT_EQ(table.decimal_comma, comma) << text;
    ASSERT_EQ(table.columns.size(), 2u) << text;
    EXPECT_EQ(table.columns[0].name, "t");
    EXPECT_EQ(table.columns[1].name, "x");
    EXPECT_THAT(table.columns[1].values, ElementsAre(1.5, -2000.0)) << text;
  }
}

TEST(ReadDelimited, ReadsUtf16AndByteOrderMarks) {
  const std::string plain = "t,µ\n0,1\n1,2\n";
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (const char32_t c : std::u32string(U"t,µ\n0,1\n1,2\n")) {
    little += static_cast<char>(c & 0xFF), little += static_cast<char>(c >> 8);
    big += static_cast<char>(c >> 8), big += static_cast<char>(c & 0xFF);
  }
  for (const std::string& text : {plain, "\xEF\xBB\xBF" + plain, little, big}) {
    const DelimitedTable table = read_delimited(text, "x.csv");
    EXPECT_EQ(table.columns[1].name, "µ");
    EXPECT_THAT(table.columns[1].values, ElementsAre(1, 2));
    EXPECT_TRUE(table.problems.empty());
  }
  const DelimitedTable latin = read_delimited("t;w [\xB0/s]\n0;1\n1;2\n", "x.csv");
  EXPECT_EQ(latin.columns[1].unit, "°/s");
  EXPECT_EQ(latin.problems.at(0).kind, "latin1");
  EXPECT_THAT(error_of(std::string("a\0b\n1,2\n", 8)), HasSubstr("zero bytes"));
}

TEST(ReadDelimited, TakesUnitsOutOfHeaders) {
  const DelimitedTable table =
      read_delimited("\"Time (s)\",X [mm],acc_x (g),F/N,q []\n0,1,2,3,4\n1,1,2,3,4\n", "x.csv");
  std::vector<std::string> names, units;
  for (const auto& column : table.columns) names.push_back(column.name), units.push_back(column.unit);
  EXPECT_THAT(names, ElementsAre("Time", "X", "acc_x", "F", "q"));
  EXPECT_THAT(units, ElementsAre("s", "mm", "g", "N", ""));
}

// OptiTrack's export: keys with values, a blank line, then rows of type, name, id, quantity, axis.
TEST(ReadDelimited, ReadsSeveralHeaderRowsWithGroups) {
  const DelimitedTable table = read_delimited(
      "Format Version,1.23,Capture Frame Rate,120.000000,Length Units,Meters\n\n"
      ",,Rigid Body,Rigid Body,Rigid Body\n,,hand,hand,hand\n,,1,1,1\n,,Rotation,Rotation,Position\n"
      "Frame,Time (Seconds),X,W,X\n0,0.0,0.1,0.9,1.5\n1,0.5,,,\n2,1.0,0.1,0.9,1.5\n",
      "x.csv");
  ASSERT_EQ(table.columns.size(), 5u);
  EXPECT_EQ(table.preface_value("length units"), "Meters");
  EXPECT_EQ(table.columns[1].label(), "Time");
  EXPECT_EQ(table.columns[1].unit, "Seconds");
  EXPECT_EQ(table.columns[4].label(), "Rigid Body hand 1 Position X");
  EXPECT_EQ(table.columns[2].label(), "Rigid Body hand 1 Rotation X");
  EXPECT_TRUE(std::isnan(table.columns[4].values[1]));
  EXPECT_EQ(table.columns[4].values[2], 1.5);
}

// Vicon's: sections, a rate, subjects that stand above their first column alone, a row of units.
TEST(ReadDelimited, ReadsSectionsAndUnitRows) {
  const std::string text =
      "Devices\n1000\n,,plate - Force,,\nFrame,Sub Frame,Fx,Fy,Fz\n,,N,N,N\n1,0,1,2,3\n1,1,1,2,3\n1,2,1,2,4\n\n"
      "Segments\n100\n,,p:rod,,,,,\nFrame,Sub Frame,RX,RY,RZ,TX,TY,TZ\n,,deg,deg,deg,mm,mm,mm\n"
      "1,0,1,2,3,4,5,6\n2,0,1,2,3,4,5,6\n3,0,1,2,3,4,5,7\n";
  const DelimitedTable force = read_delimited(text, "x.csv");
  EXPECT_EQ(force.rows(), 3u);
  EXPECT_EQ(force.columns[4].label(), "plate - Force Fz");
  EXPECT_EQ(force.columns[4].unit, "N");
  EXPECT_EQ(force.problems.at(0).kind, "further_table");
  EXPECT_THAT(force.problems.at(0).message, HasSubstr("x.csv:10"));
  const DelimitedTable pose = read_delimited(text, "x.csv", "segments");
  EXPECT_THAT(pose.preface, ElementsAre("100"));
  EXPECT_EQ(pose.columns[7].label(), "p:rod TZ");
  EXPECT_EQ(pose.columns[7].unit, "mm");
  EXPECT_THAT(pose.columns[7].values, ElementsAre(6, 6, 7));
  EXPECT_THROW(read_delimited(text, "x.csv", "Joints"), Error);
}

TEST(ReadDelimited, ReadsCommentsAsHeaderAndPreface) {
  const DelimitedTable tum =
      read_delimited("# ground truth\n# timestamp tx ty\n1.5 1 2\n# a break\n2.5 3 4\n3.5 5 6\n", "x.txt");
  EXPECT_EQ(tum.columns[1].name, "tx");
  EXPECT_THAT(tum.columns[1].values, ElementsAre(1, 3, 5));
  EXPECT_THAT(tum.preface, ElementsAre("# ground truth"));
  EXPECT_EQ(tum.row_line.back(), 6u);
  const DelimitedTable euroc = read_delimited("#timestamp [ns],w_RS_S_x [rad s^-1]\n14,1\n15,2\n", "x.csv");
  EXPECT_EQ(euroc.columns[1].name, "w_RS_S_x");
  EXPECT_EQ(euroc.columns[1].unit, "rad s^-1");
  for (const char* mark : {"#", "%", "//"}) {
    EXPECT_EQ(read_delimited(std::string(mark) + " 1 2\n1,2\n3,4\n", "x.csv").rows(), 2u) << mark;
  }
}

TEST(ReadDelimited, ReadsFilesWithoutHeader) {
  const DelimitedTable table = read_delimited("12,250000000,map,1.5\n12,500000000,map,2.5\n13,0,map,\n", "x.csv");
  EXPECT_FALSE(table.has_header());
  EXPECT_TRUE(table.columns[2].has_text);
  EXPECT_EQ(table.cell(1, 2), "map");
  EXPECT_EQ(table.columns[3].values[1], 2.5);
  EXPECT_TRUE(std::isnan(table.columns[3].values[2]));
  EXPECT_EQ(read_delimited("0.5\n0.25\n", "x.txt").columns.size(), 1u);
}

TEST(ReadDelimited, TakesShortRowsAndNamesLongOnes) {
  const DelimitedTable table = read_delimited("a,b,c\n1,2,3\n4,5\n6,NaN,7\n", "x.csv");
  EXPECT_TRUE(std::isnan(table.columns[2].values[1]));
  EXPECT_TRUE(std::isnan(table.columns[1].values[2]));
  EXPECT_EQ(table.problems.at(0).kind, "short_row");
  EXPECT_THAT(error_of("a,b\n1,2\n3,4\n5,6\n1,2,3\n"), HasSubstr("x.csv:5: 3 cells where the first row has 2"));
}

TEST(ReadDelimited, NamesWhatItCannotRead) {
  EXPECT_THAT(error_of("a;b\n1,5;2\n2,5;3\n3,5;4\n1,5;2.5\n"), HasSubstr("x.csv:5: column #2 'b': '2.5'"));
  EXPECT_THAT(error_of("a,b\n1,2\n1,2\n1,2\n\"1,2\n"), HasSubstr("x.csv:5: "));
  EXPECT_THAT(error_of(""), HasSubstr("no table of numbers"));
  EXPECT_THAT(error_of("<html>\n<body>\n"), HasSubstr("x.csv:1: no table of numbers"));
  const DelimitedTable cut = read_delimited("a,b\n1,2\n3,4\n5,6\n7,8", "x.csv");
  EXPECT_EQ(cut.rows(), 3u);
  EXPECT_EQ(cut.problems.at(0).kind, "truncated");
  std::string wide = "1";
  for (int i = 0; i < 1000; ++i) wide += ",1";
  EXPECT_THAT(error_of(wide + "\n" + wide + "\n"), HasSubstr("more than 1000 columns"));
}

}  // namespace
}  // namespace asperity
