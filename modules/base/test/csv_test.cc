#include "asperity/base/csv.h"

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

TEST(Csv, RefusesBadShapes) {
  EXPECT_THROW(CsvReader("", "f"), Error);
  EXPECT_THROW(CsvReader("a,,b\n", "f"), Error);
  EXPECT_THROW(CsvReader("a,a\n", "f"), Error);
  CsvReader csv("a,b\n1\n", "f.csv");
  EXPECT_THAT([&] { csv.next(); }, testing::ThrowsMessage<Error>("f.csv:2: 1 cells where the header has 2"));
}

}  // namespace
}  // namespace asperity
