#include "asperity/base/text.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/base/units.h"

namespace asperity {
namespace {

TEST(Text, ParsesWholeNumbersOnly) {
  EXPECT_EQ(parse_double(" 1.5 "), 1.5);
  EXPECT_EQ(parse_double("+2e-3"), 2e-3);
  EXPECT_TRUE(std::isnan(*parse_double("nan")));
  EXPECT_FALSE(parse_double("1.5x"));
  EXPECT_FALSE(parse_double(""));
  EXPECT_FALSE(parse_double("+-1"));
  EXPECT_FALSE(parse_double("1,5"));
  EXPECT_FALSE(parse_int64("9223372036854775808"));
  EXPECT_EQ(parse_int64("-5"), -5);
}

TEST(Text, NumbersReadBackExactly) {
  for (const double value : {0.1, 1.0 / 3.0, 1e-300, -2.5e10, 5e-324})
    EXPECT_EQ(parse_double(number_text(value)), value);
}

TEST(Text, Utf8) {
  EXPECT_TRUE(is_utf8("µm – ok"));
  EXPECT_FALSE(is_utf8("\xC0\x80"));          // overlong
  EXPECT_FALSE(is_utf8("\xED\xA0\x80"));      // surrogate
  EXPECT_FALSE(is_utf8("\xF5\x80\x80\x80"));  // beyond U+10FFFF
  EXPECT_EQ(printable("a\x1b\xff"), "a\\x1b\\xff");
  EXPECT_EQ(printable("\u009b2J"), "\\xc2\\x9b2J");                              // a terminal's CSI in one character
  EXPECT_EQ(printable("x\u202ey\u2066z"), "x\\xe2\\x80\\xaey\\xe2\\x81\\xa6z");  // text that is read backwards
  EXPECT_EQ(printable("a\u2028b\ufeff"), "a\\xe2\\x80\\xa8b\\xef\\xbb\\xbf");
  EXPECT_EQ(printable("µm 25°"), "µm 25°");
}

TEST(Units, NumberWithUnit) {
  EXPECT_EQ(parse_length_m("5mm", "x"), 0.005);
  EXPECT_EQ(parse_length_m("0.5um", "x"), 0.5e-6);
  EXPECT_EQ(parse_length_m("0.3 m", "x"), 0.3);
  EXPECT_EQ(parse_speed_mps("25mm/s", "x"), 0.025);
  EXPECT_EQ(parse_duration_s("250ms", "x"), 0.25);
  EXPECT_THROW(parse_length_m("5", "x"), Error);
  EXPECT_THROW(parse_length_m("5 parsec", "x"), Error);
  EXPECT_THROW(parse_length_m("infmm", "x"), Error);
}

TEST(Units, AColumnsNameEndsInItsUnitOfLength) {
  EXPECT_EQ(split_length_name("height_um")->quantity, "height");
  EXPECT_EQ(split_length_name("height_um")->unit_m, 1e-6);
  EXPECT_EQ(split_length_name("z_\xC2\xB5m")->unit_m, 1e-6);  // the micro sign
  EXPECT_EQ(split_length_name("z_\xCE\xBCm")->unit_m, 1e-6);  // the Greek letter
  EXPECT_EQ(split_length_name("mean_height_m")->quantity, "mean_height");
  EXPECT_FALSE(split_length_name("height"));
  EXPECT_FALSE(split_length_name("force_N"));
  EXPECT_FALSE(split_length_name(""));
}

// printf rounds exactly; a hair beside a half, llround of the product may take the other side.
TEST(Text, DecimalsAreThoseOfPrintf) {
  const auto text = [](double value) {
    std::string out;
    append_decimals(out, value);
    return out;
  };
  EXPECT_EQ(text(0.0), "0");
  EXPECT_EQ(text(-0.0), "0");
  EXPECT_EQ(text(-4e-13), "0");
  EXPECT_EQ(text(-1.0), "-1");
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(-2.5e-6), "-0.0000025");
  EXPECT_EQ(text(1e-12), "0.000000000001");
  EXPECT_EQ(text(999.9999999999), "999.9999999999");
  EXPECT_EQ(text(0.9999999999999), "1");
  EXPECT_EQ(text(1e3), "1000");
  EXPECT_EQ(text(1.5e300), "1.5e+300");
  EXPECT_EQ(text(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(text(-std::numeric_limits<double>::infinity()), "-inf");
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const double value = random.normal() * std::pow(10.0, random.uniform(-12.0, 2.5));
    char exact[64];
    std::snprintf(exact, sizeof exact, "%.12f", value);
    EXPECT_NEAR(*parse_double(text(value)), *parse_double(exact), 1.001e-12 + 1e-15 * std::abs(value)) << value;
    EXPECT_NEAR(*parse_double(text(value)), value, 0.501e-12 + 2e-16 * std::abs(value)) << value;
  }
}

}  // namespace
}  // namespace asperity
