#include "asperity/json/json_object.h"

#include <array>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/json/json_writer.h"
#include "asperity/json/parse_json.h"

namespace asperity {

namespace {

const std::string kFile = "s.json";

std::string fault(const std::string& text, const std::function<void(JsonObject&)>& read) {
  const Json root = parse_json(text, kFile);
  try {
    JsonObject object(root, kFile);
    read(object);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(JsonObject, ReadsWhatIsThere) {
  const Json root =
      parse_json(R"({"n":2.5,"i":-3,"t":"x","b":true,"l":[1,2,3],"o":{"k":"two"},"extra":{"z":1,"a":2}})");
  JsonObject object(root, kFile);
  double n = 0.0;
  std::int64_t i = 0;
  std::string t, absent = "as it was";
  bool b = false;
  std::array<double, 3> l{};
  object.read_number("n", n, {0.0, 3.0});
  object.read_integer("i", i, -3, 3);
  object.read_text("t", t);
  object.read_text("absent", absent);
  object.read_bool("b", b);
  object.read_numbers("l", l.data(), l.size());
  EXPECT_EQ(std::tuple(n, i, t, b, absent), std::tuple(2.5, -3, "x", true, "as it was"));
  EXPECT_THAT(l, ::testing::ElementsAre(1.0, 2.0, 3.0));
  constexpr std::array<std::string_view, 2> kNames{"one", "two"};
  JsonObject inner = object.required_object("o");
  EXPECT_EQ(inner.required("k").choice(kNames), 1U);
  inner.finish();
  EXPECT_EQ(object.extra().dump(), R"({"z":1,"a":2})");
  EXPECT_FALSE(object.optional("no"));
  object.finish();
}

TEST(JsonObject, NamesFileLineColumnPathAndValue) {
  EXPECT_EQ(fault("[]", [](JsonObject&) {}), "s.json:1:1: must be a JSON object, found an array");
  EXPECT_EQ(fault("{\n \"textures\": [{}, {\"file\": 7}]}",
                  [](JsonObject& o) { JsonObject(o.required("textures").elements(10).at(1)).required("file").text(); }),
            "s.json:2:28: key 'textures[1].file': must be a text, found 7");
  EXPECT_EQ(fault("{\"a\":{\n}}", [](JsonObject& o) { o.required_object("a").required("b"); }),
            "s.json:1:6: key 'a.b': is missing");
  EXPECT_EQ(fault("{\"a\":1,\n\"b\":2}",
                  [](JsonObject& o) {
                    o.required("a");
                    o.finish();
                  }),
            "s.json:2:5: key 'b': is not known here; what others add belongs in 'extra'");
  EXPECT_EQ(fault("{\"a\":5}",
                  [](JsonObject& o) {
                    o.required("a").number({0.0, 1.0});
                  }),
            "s.json:1:6: key 'a': 5 is outside 0 to 1");
  EXPECT_EQ(fault("{\"a\":18446744073709551615}", [](JsonObject& o) { o.required("a").integer(0, INT64_MAX); }),
            "s.json:1:6: key 'a': 18446744073709551615 is outside 0 to 9223372036854775807");
  EXPECT_EQ(fault("{\"a\":1.0}", [](JsonObject& o) { o.required("a").integer(0, 9); }),
            "s.json:1:6: key 'a': must be a whole number, found 1.0");
  EXPECT_EQ(fault("{\"a\":[1,\nnull]}", [](JsonObject& o) { o.required("a").numbers(9); }),
            "s.json:2:1: key 'a[1]': must be a number, found null");
  EXPECT_EQ(fault("{\"a\":[1,2]}", [](JsonObject& o) { o.required("a").numbers(1); }),
            "s.json:1:6: key 'a': has 2 entries, more than 1");
  EXPECT_EQ(fault("{\"a\":\"xyz\"}", [](JsonObject& o) { o.required("a").text(2); }),
            "s.json:1:6: key 'a': a text of 3 bytes, more than 2");
  EXPECT_EQ(fault("{\"extra\":3}", [](JsonObject& o) { o.extra(); }),
            "s.json:1:10: key 'extra': must be an object, found 3");
  EXPECT_EQ(fault("{\"format\":\"b\"}", [](JsonObject& o) { o.require_format("a"); }),
            "s.json:1:11: key 'format': must be \"a\", found \"b\"");
  const Json made{{"a", 1}};
  EXPECT_THAT(
      [&] { JsonObject(made, kFile).finish(); },
      ::testing::ThrowsMessage<Error>("s.json: key 'a': is not known here; what others add belongs in 'extra'"));
}

TEST(JsonWriter, WritesOneKeyALine) {
  JsonWriter out;
  const std::array<double, 4> values{1.0, 1e6, -0.0, 0.1};
  out.text("name", "a \"b\"\n");
  out.numbers("n", values.data(), values.size());
  out.matrix("m", values.data(), 2, 2);
  out.begin_array("list");
  out.begin_element();
  out.integer("i", -1);
  out.boolean("yes", true);
  out.end_object();
  out.end_array();
  out.raw("extra", "{}");
  EXPECT_EQ(out.finish(), R"({
 "name": "a \"b\"\n",
 "n": [1, 1000000, -0.0, 0.1],
 "m": [[1, -0.0], [1000000, 0.1]],
 "list": [
  {
   "i": -1,
   "yes": true
  }
 ],
 "extra": {}
}
)");
  EXPECT_THROW(out.number("x", std::numeric_limits<double>::infinity()), Error);
  EXPECT_THROW(out.text("x", "\xff"), Error);
}

}  // namespace

}  // namespace asperity
