#include "asperity/json/json.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/json/parse_json.h"

namespace asperity {

namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Oracle = nlohmann::ordered_json;

TEST(Json, BuildsWhatTheBracesSay) {
  const std::map<std::string, int> counts{{"a", 1}, {"b", 2}};
  Json out{{"text", "wood"}, {"list", {1, 2.5, "x", nullptr, true}}, {"counts", counts}, {"one", {3}}};
  out["numbers"] = std::vector<double>{0.1, 0.2};
  out["inner"] = {{"deep", {{"er", Json::array()}}}};
  out["nothing"];
  EXPECT_EQ(out.dump(),
            R"({"text":"wood","list":[1,2.5,"x",null,true],"counts":{"a":1,"b":2},"one":[3],"numbers":[0.1,0.2],)"
            R"("inner":{"deep":{"er":[]}},"nothing":null})");
  EXPECT_EQ(Json({"a", "b"}).dump(), R"(["a","b"])");
  EXPECT_EQ(Json(Json::object()).dump(1), "{}");
}

TEST(Json, PartsBecomeTheWhole) {
  Json value{{"a", {{"b", "a text that is too long for its place in a string"}}}};
  value = value["a"];
  EXPECT_EQ(value.dump(), R"({"b":"a text that is too long for its place in a string"})");
  value = std::move(value["b"]);
  EXPECT_EQ(value, "a text that is too long for its place in a string");
  Json list{1, 2};
  list.push_back(list);
  EXPECT_EQ(list.dump(), "[1,2,[1,2]]");
}

TEST(Json, KeepsAllBitsOfWholeNumbers) {
  const std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
  const std::int64_t smallest = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(Json(largest).dump(), std::to_string(largest));
  EXPECT_EQ(parse_json(std::to_string(largest)).get<std::uint64_t>(), largest);
  EXPECT_EQ(parse_json(std::to_string(smallest)).get<std::int64_t>(), smallest);
  EXPECT_NE(Json(largest), Json(smallest));
  EXPECT_NE(Json(largest), Json(-1));
  EXPECT_EQ(Json(3), Json(3U));
  EXPECT_EQ(Json(3), Json(3.0));
  EXPECT_THROW(Json(largest).get<std::int64_t>(), Error);
  EXPECT_THROW(Json(300).get<std::uint8_t>(), Error);
  EXPECT_THROW(Json(-1).get<unsigned>(), Error);
  EXPECT_THROW(Json("1").get<int>(), Error);
  EXPECT_THROW(Json(1e300).get<int>(), Error);
}

TEST(Json, RefusesWhatDoesNotFitItsKind) {
  const Json number(3);
  EXPECT_THAT([&] { static_cast<void>(number.text()); }, ThrowsMessage<Error>(HasSubstr("not a text: 3")));
  EXPECT_THROW(static_cast<void>(number.at("a")), Error);
  EXPECT_THROW(static_cast<void>(number.begin()), Error);
  EXPECT_THAT([] { static_cast<void>(Json::object().at("a\x01")); }, ThrowsMessage<Error>(HasSubstr("'a\\x01'")));
  EXPECT_THROW(static_cast<void>(Json::array().at(0)), Error);
  EXPECT_EQ(number.find("a"), nullptr);
  EXPECT_EQ(Json().size(), 0U);
  EXPECT_EQ(Json().begin(), Json().end());
}

TEST(Json, LargeObjectsAreThoseOfTheOracle) {
  // Members are set, set anew, taken out and copied, in small objects and in those that have an index.
  Random random(7);
  Json ours = Json::object();
  Oracle oracle = Oracle::object();
  for (int i = 0; i < 4000; ++i) {
    const std::string key = "k" + std::to_string(static_cast<int>(60.0 * random.uniform()));
    if (random.uniform() < 0.4) {
      EXPECT_EQ(ours.erase(key), oracle.erase(key));
    } else {
      ours[key] = i;
      oracle[key] = i;
    }
    if (i % 100 == 0) {
      const Json copy = ours;
      ours = Json(copy);
      EXPECT_EQ(copy.dump(), oracle.dump());
    }
    ASSERT_EQ(ours.contains(key), oracle.contains(key));
  }
  EXPECT_EQ(ours.dump(2), oracle.dump(2));
  EXPECT_EQ(ours.dump_sorted(), nlohmann::json::parse(oracle.dump()).dump());
}

TEST(Json, WritesNumbersAsTheOracleDoes) {
  Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    const double value = (random.uniform() - 0.5) * std::pow(10.0, std::round(600.0 * random.uniform() - 300.0));
    const double rounded = std::round(1e4 * random.uniform()) * 1e-3;
    EXPECT_EQ(Json(value).dump(), Oracle(value).dump());
    EXPECT_EQ(Json(rounded).dump(), Oracle(rounded).dump());
    EXPECT_EQ(parse_json(Json(value).dump()).get<double>(), value);
  }
  for (const double value : {0.0, -0.0, 1.0, 1e15, 1e16, 1e22, 5e-324, 1.7976931348623157e308}) {
    EXPECT_EQ(Json(value).dump(), Oracle(value).dump());
  }
  EXPECT_EQ(Json(std::numeric_limits<double>::quiet_NaN()).dump(), "null");
  EXPECT_TRUE(number_or_null(std::numeric_limits<double>::infinity()).is_null());
}

TEST(Json, WritesTextsAsTheOracleDoes) {
  for (const std::string text : {"", "plain", "\"\\/\b\f\n\r\t\x01\x1f\x7f", "µ\u2028😀", "a\xff\xc3("}) {
    EXPECT_EQ(Json(text).dump_repaired(), Oracle(text).dump(-1, ' ', false, Oracle::error_handler_t::replace));
  }
  EXPECT_THAT([] { Json("a\xff").dump(); }, ThrowsMessage<Error>(HasSubstr("not UTF-8")));
  std::ostringstream out;
  out << Json{{"a", 1}};
  EXPECT_EQ(out.str(), R"({"a":1})");
}

}  // namespace

}  // namespace asperity
