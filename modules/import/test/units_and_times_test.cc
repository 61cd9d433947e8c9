#include <gmock/gmock.h>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/import/import_unit.h"
#include "parse_time.h"

namespace asperity {
namespace {

using testing::HasSubstr;

double factor(const char* text, Quantity quantity) { return parse_import_unit(text, quantity, "x").factor; }

// Definitions: BIPM, SI Brochure 9 (2019); NIST SP 811: pound 0.453 592 37 kg, inch 25.4 mm, g_n 9.806 65 m/s².
TEST(ImportUnit, KnowsTheWordsOfTheField) {
  EXPECT_EQ(factor("mm", Quantity::kLength), 1e-3);
  EXPECT_EQ(factor("Millimeters", Quantity::kLength), 1e-3);
  EXPECT_EQ(factor("µm", Quantity::kLength), 1e-6);
  EXPECT_EQ(factor("inch", Quantity::kLength), 0.0254);
  for (const char* text : {"deg/s", "dps", "°/s", "DPS", "deg s^-1", "deg s⁻¹"}) {
    EXPECT_DOUBLE_EQ(factor(text, Quantity::kRate), std::numbers::pi / 180.0) << text;
  }
  for (const char* text : {"m/s²", "m/s^2", "m s^-2", "m/s/s", "m s⁻²"}) {
    EXPECT_EQ(factor(text, Quantity::kAcceleration), 1.0) << text;
  }
  EXPECT_EQ(factor("g", Quantity::kAcceleration), 9.80665);
  EXPECT_DOUBLE_EQ(factor("mg", Quantity::kAcceleration), 9.80665e-3);
  EXPECT_EQ(factor("Gal", Quantity::kAcceleration), 1e-2);
  EXPECT_DOUBLE_EQ(factor("g", Quantity::kForce), 9.80665e-3);
  EXPECT_DOUBLE_EQ(factor("lbf", Quantity::kForce), 4.4482216152605);
  EXPECT_EQ(factor("mN", Quantity::kForce), 1e-3);
  EXPECT_DOUBLE_EQ(factor("1/16384 g", Quantity::kAcceleration), 9.80665 / 16384.0);
  EXPECT_DOUBLE_EQ(factor("0.061mg", Quantity::kAcceleration), 0.061 * 9.80665e-3);
  EXPECT_DOUBLE_EQ(factor("1/131 deg/s", Quantity::kRate), std::numbers::pi / 180.0 / 131.0);
  EXPECT_EQ(parse_import_unit("µs", Quantity::kTime, "x").ns, 1000);
  EXPECT_EQ(parse_import_unit("epoch ms", Quantity::kTime, "x").ns, 1'000'000);
  EXPECT_TRUE(parse_import_unit("iso", Quantity::kTime, "x").is_date);
}

TEST(ImportUnit, NamesTheKnownOnesForAnUnknown) {
  for (const char* text : {"furlong", "counts", "MN", "0 g", "1/0 g", "", "g"}) {
    try {
      parse_import_unit(text, Quantity::kLength, "pose.csv: X");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("pose.csv: X: '" + std::string(text) + "'"));
      EXPECT_THAT(error.what(), HasSubstr("m, mm, cm"));
    }
  }
  EXPECT_FALSE(find_import_unit("MN", Quantity::kForce));
  EXPECT_FALSE(find_import_unit("counts", Quantity::kAcceleration));
}

TEST(ParseTime, KeepsNanosecondsThatADoubleDoesNot) {
  EXPECT_EQ(parse_decimal_ns("1403636579758555392", 1), 1403636579758555392);
  EXPECT_EQ(parse_decimal_ns("1403636579.758555392", 1'000'000'000), 1403636579758555392);
  EXPECT_EQ(parse_decimal_ns("1403636579758,555392", 1'000'000), 1403636579758555392);
  EXPECT_EQ(parse_decimal_ns("0.0035", 1'000'000'000), 3'500'000);
  EXPECT_EQ(parse_decimal_ns("-1.5e-3", 1'000'000'000), -1'500'000);
  EXPECT_EQ(parse_decimal_ns("2.5", 60'000'000'000), 150'000'000'000);
  EXPECT_EQ(parse_decimal_ns("0.1234567894", 1'000'000'000), 123'456'789);
  EXPECT_EQ(parse_decimal_ns("0.1234567896", 1'000'000'000), 123'456'790);
  EXPECT_EQ(parse_decimal_ns("1e-300", 1'000'000'000), 0);
  for (const char* text : {"", "-", "1.2.3", "x", "1e", "1e999", "99999999999999999999", "9e18"}) {
    EXPECT_FALSE(parse_decimal_ns(text, 1'000'000'000)) << text;
  }
}

// Oracle: `date -u -d 2026-05-01T12:30:00Z +%s` prints 1777638600.
TEST(ParseTime, ReadsDates) {
  EXPECT_EQ(parse_date_time_ns("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(parse_date_time_ns("2026-05-01T12:30:00.25Z"), 1777638600250000000);
  EXPECT_EQ(parse_date_time_ns("2026-05-01 14:30:00,25+02:00"), 1777638600250000000);
  EXPECT_EQ(parse_date_time_ns("2026/05/01 10:30:00-0200"), 1777638600000000000);
  EXPECT_EQ(parse_date_time_ns("00:00:01.5"), 1'500'000'000);
  for (const char* text : {"2026-02-30T00:00:00Z", "2026-05-01", "25:00:00", "2026-05-01T12:30:00.Z", "12", "-"}) {
    EXPECT_FALSE(parse_date_time_ns(text)) << text;
  }
}

}  // namespace
}  // namespace asperity
