#include "asperity/base/csv.h"

#include <cmath>

#include <gmock/gmock.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

TEST(Csv, ReadsRowsAndReportsPlaces) {
  CsvReader csv("a,b\r\n1,2.5\r\n\n# note\nx,4\n", "f.csv");
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.integer(0), 1);
  EXPECT_EQ(csv.number(csv.require("b")), 2.5);
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.line(), 5u);
  EXPECT_THAT([&] { csv.number(0); }, testing::ThrowsMessage<Error>("f.csv:5: column 'a': 'x' is not a number"));
  EXPECT_FALSE(csv.next());
  EXPECT_FALSE(csv.truncated());
}

TEST(Csv, PassesOverAnUnfinishedLastLine) {
  CsvReader csv("a,b\n1,2\n3,", "f.csv");
  EXPECT_TRUE(csv.next());
  EXPECT_FALSE(csv.next());
  EXPECT_TRUE(csv.truncated());
}

TEST(Csv, WholeNumbersAreExact) {
  CsvReader csv("a\n-0\n999999999999999\n9007199254740993\n-17\n007\n", "f.csv");
  const auto next_number = [&] {
    csv.next();
    return csv.number(0);
  };
  const double minus_zero = next_number();
  EXPECT_EQ(minus_zero, 0.0);
  EXPECT_TRUE(std::signbit(minus_zero));
  EXPECT_EQ(next_number(), 999999999999999.0);
  EXPECT_EQ(next_number(), 9007199254740992.0);  // 2^53 + 1 is no double: the nearest, ties to even
  EXPECT_EQ(next_number(), -17.0);
  EXPECT_EQ(next_number(), 7.0);
  EXPECT_FALSE(csv.next());
  CsvReader minus("a\n-\n", "f.csv");
  minus.next();
  EXPECT_THROW(minus.number(0), Error);
}

TEST(Csv, RefusesBadShapes) {
  EXPECT_THROW(CsvReader("", "f"), Error);
  EXPECT_THROW(CsvReader("a,,b\n", "f"), Error);
  EXPECT_THROW(CsvReader("a,a\n", "f"), Error);
  CsvReader csv("a,b\n1\n", "f.csv");
  EXPECT_THAT([&] { csv.next(); }, testing::ThrowsMessage<Error>("f.csv:2: 1 cell where the header has 2"));
}

TEST(Csv, FirstLineOfNumbersIsARowWhereAHeaderIsOptional) {
  CsvReader csv(" # note\n1, 2\n3,nan\n", "f.csv", CsvHeader::kOptional);
  EXPECT_TRUE(csv.columns().empty());
  EXPECT_EQ(csv.width(), 2u);
  EXPECT_EQ(csv.find("1"), std::nullopt);
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.number(1), 2.0);
  EXPECT_EQ(csv.line(), 2u);
  ASSERT_TRUE(csv.next());
  EXPECT_TRUE(std::isnan(csv.finite_or_nan(1)));
  EXPECT_THAT([&] { csv.finite(1); }, testing::ThrowsMessage<Error>("f.csv:3: column 2: 'nan' is not finite"));
  EXPECT_FALSE(csv.next());

  CsvReader named("a,2\n-inf,1\n3\n", "f.csv", CsvHeader::kOptional);
  EXPECT_EQ(named.columns().size(), 2u);
  ASSERT_TRUE(named.next());
  EXPECT_THAT([&] { named.finite_or_nan(0); },
              testing::ThrowsMessage<Error>("f.csv:2: column 'a': '-inf' is infinite"));
  EXPECT_THAT([&] { named.next(); }, testing::ThrowsMessage<Error>("f.csv:3: 1 cell where the header has 2"));
  EXPECT_THROW(CsvReader("\n", "f", CsvHeader::kOptional), Error);
}

}  // namespace
}  // namespace asperity
