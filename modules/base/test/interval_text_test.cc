#include "asperity/base/interval_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "asperity/base/nan.h"

namespace asperity {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

TEST(IntervalText, RoundsTheValueToTheLastDigitOfTheError) {
  EXPECT_EQ(interval_text(112.3, 27.1, 1), "110 ± 30");
  EXPECT_EQ(interval_text(112.3, 27.1), "112 ± 27");
  EXPECT_EQ(interval_text(79.98432, 0.0611), "79.984 ± 0.061");
  EXPECT_EQ(interval_text(1547.34, 182.9), "1550 ± 180");
  EXPECT_EQ(interval_text(-2.5, 0.1), "-2.50 ± 0.10");
  EXPECT_EQ(interval_text(0.0003060889, 4.81e-7), "0.00030609 ± 0.00000048");
}

// Rounding may give the error one digit more in front: 0.0996 is 0.10 and not 0.100.
TEST(IntervalText, CountsTheDigitsAfterRounding) {
  EXPECT_EQ(interval_text(5.4321, 0.0996), "5.43 ± 0.10");
  EXPECT_EQ(interval_text(543.21, 9.96), "543 ± 10");
  EXPECT_EQ(interval_text(543.21, 96.0, 1), "500 ± 100");
}

TEST(IntervalText, OfZeroAndOfAnErrorAboveTheValue) {
  EXPECT_EQ(interval_text(0.0, 0.0), "0 ± 0");
  EXPECT_EQ(interval_text(0.0, 0.25), "0.00 ± 0.25");
  EXPECT_EQ(interval_text(3.2, 0.0), "3.2 ± 0");
  EXPECT_EQ(interval_text(3.0, 41.0), "3 ± 41");
  EXPECT_EQ(interval_text(3.0, 41.0, 1), "0 ± 40");
  EXPECT_EQ(interval_text(-3.0, 41.0, 1), "0 ± 40");
  EXPECT_EQ(interval_text(-0.001, 0.25), "0.00 ± 0.25");
  EXPECT_EQ(interval_text(1e-300, 2.0), "0.0 ± 2.0");
}

TEST(IntervalText, OfVerySmallAndVeryLargeNumbers) {
  EXPECT_EQ(interval_text(2.34e-6, 1.2e-7), "0.00000234 ± 0.00000012");
  EXPECT_EQ(interval_text(2.34e-9, 1.2e-10), "2.34e-09 ± 1.2e-10");
  EXPECT_EQ(interval_text(0.0, 1.2e-10), "0 ± 1.2e-10");
  EXPECT_EQ(interval_text(2.34e14, 1.2e13), "234000000000000 ± 12000000000000");
  EXPECT_EQ(interval_text(2.34e20, 1.2e19), "2.34e+20 ± 1.2e+19");
  // A double has no more than these digits.
  EXPECT_EQ(interval_text(1.0, 1e-30), "1.00000000000000 ± 0.00000000000000");
}

TEST(IntervalText, OfWhatIsNotKnown) {
  EXPECT_EQ(interval_text(kNan, 1.0), "not determined");
  EXPECT_EQ(interval_text(kNan, kNan), "not determined");
  EXPECT_EQ(interval_text(kUnbounded, 1.0), "not determined");
  EXPECT_EQ(interval_text(112.34567, kNan), "112.35");
  EXPECT_EQ(interval_text(112.34567, kUnbounded), "112.35");
  EXPECT_EQ(interval_text(112.34567, -1.0), "112.35");
  EXPECT_EQ(interval_text(112345.67, kNan, 2, 3), "112000");
}

// What is printed is the number to half of its last digit, in fixed notation.
TEST(IntervalText, IsTheNumberToHalfOfItsLastDigit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-5.0, 8.0), sign(-1.0, 1.0);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::copysign(std::pow(10.0, exponent(random)), sign(random));
    const double error = std::pow(10.0, exponent(random));
    const IntervalText text = interval_parts(value, error);
    ASSERT_EQ((text.value + text.error).find('e'), std::string::npos) << text.value;
    const double step = std::pow(10.0, std::floor(std::log10(error)) - 1.0);
    EXPECT_NEAR(std::stod(text.error), error, 5.01 * step);
    EXPECT_NEAR(std::stod(text.error), error, 0.0501 * error);
    EXPECT_NEAR(std::stod(text.value), value, 5.01 * step + 1e-14 * std::abs(value));
    const auto point = text.error.find('.');
    EXPECT_EQ(text.value.find('.') == std::string::npos, point == std::string::npos);
    if (point != std::string::npos) {
      EXPECT_EQ(text.value.size() - text.value.find('.'), text.error.size() - point) << text.value;
    }
  }
}

}  // namespace
}  // namespace asperity
