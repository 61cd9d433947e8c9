#include "asperity/studio/block.h"

#include <gmock/gmock.h>

#include <cstring>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/json/parse_json.h"

namespace asperity::studio {
namespace {

TEST(Block, IsReadAsItIsDocumented) {
  BlockWriter writer("test");
  writer.head()["note"] = "ü";
  const std::vector<double> d{1.5, -2.0, 3.25};
  const std::vector<std::uint8_t> b{1, 2, 3, 4, 5, 6};
  writer.add("d", d);
  writer.add("b", b, {2, 3});
  const std::string frame = writer.take();
  ASSERT_GE(frame.size(), 8U);
  EXPECT_EQ(frame.substr(0, 4), "ASB1");
  std::uint32_t length = 0;
  std::memcpy(&length, frame.data() + 4, 4);
  const Json head = parse_json(frame.substr(8, length));
  EXPECT_EQ(head["kind"], "test");
  EXPECT_EQ(head["note"], "ü");
  ASSERT_EQ(head["arrays"].size(), 2U);
  EXPECT_EQ(head["arrays"][1]["shape"], parse_json("[2,3]"));
  const auto at = head["arrays"][0]["offset"].get<std::size_t>();
  EXPECT_EQ(at % 8, 0U);
  std::vector<double> back(3);
  std::memcpy(back.data(), frame.data() + at, 24);
  EXPECT_EQ(back, d);
  const auto bytes_at = head["arrays"][1]["offset"].get<std::size_t>();
  EXPECT_EQ(bytes_at % 8, 0U);
  EXPECT_EQ(frame.substr(bytes_at, 6), std::string("\1\2\3\4\5\6"));
}

TEST(Block, RefusesShapesAndNamesThatDoNotFit) {
  BlockWriter writer("test");
  const std::vector<float> x{1, 2, 3};
  EXPECT_THROW(writer.add("x", x, {2, 2}), Error);
  writer.add("x", x);
  EXPECT_THROW(writer.add("x", x), Error);
}

}  // namespace
}  // namespace asperity::studio
