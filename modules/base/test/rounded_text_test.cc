#include "asperity/base/rounded_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace asperity {
namespace {

TEST(RoundedText, HasFewDigits) {
  EXPECT_EQ(rounded_text(0.6750743374746287), "0.675");
  EXPECT_EQ(rounded_text(2.1785154453337743, 4), "2.179");
  EXPECT_EQ(rounded_text(-47.96), "-48");
  EXPECT_EQ(rounded_text(0.0), "0");
  EXPECT_EQ(rounded_text(1e-7), "1e-07");
}

TEST(RoundedText, IsFixedForLargeNumbers) {
  EXPECT_EQ(rounded_text(110.4, 2), "110");
  EXPECT_EQ(rounded_text(-12345.0, 2), "-12000");
  EXPECT_EQ(rounded_text(99.7, 2), "100");
  EXPECT_EQ(rounded_text(123456789.0), "123000000");
  EXPECT_EQ(rounded_text(9.996e14), "1e+15");
}

TEST(RoundedText, SaysWhatIsNoNumber) {
  EXPECT_EQ(rounded_text(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(rounded_text(std::numeric_limits<double>::infinity()), "inf");
}

}  // namespace
}  // namespace asperity
