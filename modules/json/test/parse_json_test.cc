#include "asperity/json/parse_json.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/testkit/count_allocations.h"

namespace asperity {

namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Oracle = nlohmann::ordered_json;

std::string fault(const std::string& text, const JsonLimits& limits = {}) {
  try {
    parse_json(text, "x.json", limits);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// A random document; its layout, too.
std::string random_text(Random& random, int depth) {
  const auto draw = [&](int n) { return static_cast<int>(random.uniform() * n); };
  const auto blank = [&] { return std::string(draw(3) == 0 ? "\n " : draw(2) == 0 ? "\t" : ""); };
  constexpr std::array kLeaves{"null",
                               "true",
                               "false",
                               "0",
                               "-0",
                               "12",
                               "-7",
                               "0.5",
                               "1e5",
                               "-2.5E-3",
                               "\"\"",
                               "\"a\"",
                               "\"\\\"\"",
                               "\"\\\\\"",
                               "\"a\\n\"",
                               "\"\\u00e9\"",
                               "\"\\ud83d\\ude00\"",
                               "\"µ\\\\\\\"\""};
  const int kind = depth > 4 ? 0 : draw(4);
  if (kind < 2) return blank() + kLeaves.at(static_cast<std::size_t>(draw(kLeaves.size()))) + blank();
  std::string out = blank() + (kind == 2 ? "[" : "{");
  const int count = draw(20);
  for (int i = 0; i < count; ++i) {
    if (i > 0) out += ",";
    if (kind == 3) out += blank() + "\"k" + std::to_string(i) + "\"" + blank() + ":";
    out += random_text(random, depth + 1);
  }
  return out + blank() + (kind == 2 ? "]" : "}") + blank();
}

TEST(ParseJson, ReadsWhatTheOracleReads) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    std::string text = random_text(random, 0);
    EXPECT_EQ(parse_json(text).dump(), Oracle::parse(text).dump()) << text;
    // One byte changed: both take it, or both refuse it.
    text[static_cast<std::size_t>(random.uniform() * static_cast<double>(text.size()))] =
        "{}[],:\"\\01-.eEx\n\xc3"[static_cast<std::size_t>(random.uniform() * 17)];
    const Oracle expected = Oracle::parse(text, nullptr, false);
    if (expected.is_discarded()) {
      EXPECT_THAT(fault(text), HasSubstr("x.json:")) << text;
    } else if (fault(text).find("appears twice") == std::string::npos) {
      EXPECT_EQ(parse_json(text).dump(), expected.dump()) << text;
    }
  }
}

TEST(ParseJson, EachValueKnowsWhereItBegan) {
  const Json root = parse_json("\xEF\xBB\xBF{\n  \"a\": [1,\n 22 ,\"x\\\"y\", null],\n \"b\" : {\"c\":-1.5e3\n}}");
  const auto place = [](const Json& value) { return std::pair(value.place().line, value.place().column); };
  EXPECT_EQ(place(root), std::pair(std::size_t{1}, std::size_t{1}));
  EXPECT_EQ(place(root["a"]), std::pair(std::size_t{2}, std::size_t{8}));
  EXPECT_EQ(place(root["a"][0]), std::pair(std::size_t{2}, std::size_t{9}));
  EXPECT_EQ(place(root["a"][1]), std::pair(std::size_t{3}, std::size_t{2}));
  EXPECT_EQ(place(root["a"][2]), std::pair(std::size_t{3}, std::size_t{6}));
  EXPECT_EQ(place(root["a"][3]), std::pair(std::size_t{3}, std::size_t{14}));
  EXPECT_EQ(place(root["b"]), std::pair(std::size_t{4}, std::size_t{8}));
  EXPECT_EQ(place(root["b"]["c"]), std::pair(std::size_t{4}, std::size_t{13}));
  EXPECT_EQ(Json(1).place().line, 0U);
}

TEST(ParseJson, RefusesWithLineColumnAndPath) {
  EXPECT_THAT(fault(""), HasSubstr("x.json:1:1: not JSON: "));
  EXPECT_THAT(fault("{\n\"a\": [1, {\"b\": tru}]}"), HasSubstr("x.json:2:19: not JSON: "));
  EXPECT_THAT(fault("{\n\"a\": [1, {\"b\": tru}]}"), HasSubstr("(in 'a[1]')"));
  EXPECT_THAT(fault("[1] 2"), HasSubstr("x.json:1:5: not JSON: "));
  EXPECT_THAT(fault("[1e999]"), HasSubstr("number overflow parsing '1e999'"));
  EXPECT_THAT(fault("[1,\n\"a\xff\"]"), HasSubstr("x.json:2:3: not UTF-8 text: "));
  EXPECT_THAT(fault("[\"\\ud800\"]"), HasSubstr("not JSON"));
  EXPECT_THAT(fault("[NaN]"), HasSubstr("not JSON"));
  EXPECT_THAT(fault("[1] // remark"), HasSubstr("not JSON"));
  EXPECT_EQ(fault("{\"a\": {\"b\": 1,\n \"c\": 2, \"b\": 3}}"), "x.json:2:10: key 'a.b' appears twice");
  EXPECT_TRUE(parse_json_or_null("{").is_null());
}

TEST(ParseJson, FindsRepeatedKeysInLargeObjects) {
  std::string text = "{";
  for (int i = 0; i < 5000; ++i) text += "\"k" + std::to_string(i) + "\":0,\n";
  EXPECT_EQ(fault(text + "\"k4999\":0}"), "x.json:5001:1: key 'k4999' appears twice");
  EXPECT_EQ(fault(text + "\"k0\":0}"), "x.json:5001:1: key 'k0' appears twice");
  EXPECT_EQ(fault(text + "\"k\":0}"), "");
}

TEST(ParseJson, KeepsToItsLimits) {
  JsonLimits limits;
  limits.bytes = 30;
  limits.depth = 3;
  limits.values = 5;
  limits.keys = 2;
  EXPECT_EQ(fault("[[[1]],\"2\",3]", limits), "x.json:1:12: more than 5 values");
  EXPECT_EQ(fault("[[[1]],\"2\"]", limits), "");
  EXPECT_EQ(fault("[[{\"a\":[]}]]", limits), "x.json:1:8: nested more than 3 deep (in '[0][0]')");
  EXPECT_EQ(fault("{\"a\":1,\"b\":2}", limits), "");
  EXPECT_EQ(fault("{\"a\":1,\n\"b\":2,\"c\":3}", limits), "x.json:2:7: an object with more than 2 keys");
  EXPECT_EQ(fault(std::string(31, ' '), limits), "x.json: 31 bytes of JSON, more than 30");
}

TEST(ParseJson, ALongReadIsCancelled) {
  std::string text = "[0";
  for (int i = 0; i < 100'000; ++i) text += ",0";
  text += "]";
  int asked = 0;
  double last = 0.0;
  Observer observer;
  observer.cancelled = [&] { return ++asked == 5; };
  observer.progress = [&](std::string_view, double fraction) { last = fraction; };
  EXPECT_THROW(parse_json(text, "x.json", {}, observer), Cancelled);
  EXPECT_EQ(asked, 5);
  EXPECT_GT(last, 0.1);
  EXPECT_LT(last, 0.5);
}

// What strangers send to keep a reader busy: texts of about `bytes`.
struct Shape {
  const char* name;
  std::function<std::string(std::size_t bytes)> text;
};

std::string repeated(std::size_t bytes, const std::string& open, const std::function<std::string(std::size_t)>& one,
                     const std::string& close) {
  std::string out = open;
  for (std::size_t i = 0; out.size() < bytes; ++i) out += (i > 0 ? "," : "") + one(i);
  return out + close;
}

std::vector<Shape> shapes() {
  const auto fixed = [](std::string text) { return [text = std::move(text)](std::size_t) { return text; }; };
  const auto numbered = [](std::size_t i) {
    const std::string digits = std::to_string(i);
    return "\"" + std::string(8 - digits.size(), '0') + digits + "\":0";
  };
  return {
      {"empty objects", [=](std::size_t n) { return repeated(n, "[", fixed("{}"), "]"); }},
      {"empty objects in a member", [=](std::size_t n) { return repeated(n, "{\"a\":[", fixed("{}"), "]}"); }},
      {"numbers", [=](std::size_t n) { return repeated(n, "[", fixed("-12.5e-3"), "]"); }},
      {"texts", [=](std::size_t n) { return repeated(n, "[", fixed("\"\\\"\\\\x\""), "]"); }},
      {"one text", [=](std::size_t n) { return "\"" + std::string(n, 'a') + "\""; }},
      {"one text of escapes", [=](std::size_t n) { return repeated(n, "[\"", fixed("\\\"\\\\"), "\"]"); }},
      {"one number", [=](std::size_t n) { return "0." + std::string(n, '1'); }},
      {"blank lines", [=](std::size_t n) { return std::string(n, '\n') + "1"; }},
      {"nested lists", [=](std::size_t n) { return repeated(n, "[", fixed("[[[[[[[[0]]]]]]]]"), "]"); }},
      {"nested objects", [=](std::size_t n) { return repeated(n, "[", fixed("{\"a\":{\"a\":{\"a\":{}}}}"), "]"); }},
      {"a wide object", [=](std::size_t n) { return repeated(n, "{", numbered, "}"); }},
      {"a wide object whose keys fall",
       [=](std::size_t n) {
         return repeated(
             n, "{", [=](std::size_t i) { return numbered(99'999'999 - i); }, "}");
       }},
      {"objects of sixteen keys",
       [=](std::size_t n) { return repeated(n, "[", fixed(repeated(16 * 13, "{", numbered, "}")), "]"); }},
  };
}

// The work of reading grows as the text does: counted, not timed.
TEST(ParseJson, WorkIsLinearInTheSize) {
  JsonLimits limits;
  limits.values = limits.keys = 100'000'000;
  for (const Shape& shape : shapes()) {
    double bytes_each = 0.0, allocations_each = 0.0;
    for (const std::size_t size : {std::size_t{100'000}, std::size_t{1'000'000}, std::size_t{10'000'000}}) {
      const std::string text = shape.text(size);
      const auto n = static_cast<double>(text.size());
      const std::size_t before = testkit::count_allocations();
      JsonWork work;
      parse_json(text, "x.json", limits, {}, &work);
      const auto allocations = static_cast<double>(testkit::count_allocations() - before);
      EXPECT_LE(static_cast<double>(work.bytes), 3.0 * n + 100.0) << shape.name;
      if (bytes_each > 0.0) {
        EXPECT_LE(static_cast<double>(work.bytes) / n, 1.01 * bytes_each) << shape.name;
        EXPECT_LE(allocations / n, 1.05 * allocations_each + 100.0 / n) << shape.name;
      }
      bytes_each = static_cast<double>(work.bytes) / n;
      allocations_each = allocations / n;
      // Of k keys, each is looked for and then put in its place: twice the depth of a red-black tree, 2 log2(k), and
      // one more each. Up to sixteen keys are compared with each other.
      const double k = static_cast<double>(work.values);
      EXPECT_LE(static_cast<double>(work.comparisons), k * (4.0 * std::log2(k + 2.0) + 20.0)) << shape.name;
    }
  }
}

// The same for what is refused: the fault is at the end.
TEST(ParseJson, RefusingIsNoMoreWorkThanReading) {
  for (const Shape& shape : shapes()) {
    std::string text = shape.text(1'000'000);
    text.back() = '\x01';
    const std::size_t before = testkit::count_allocations();
    EXPECT_THROW(parse_json(text), Error) << shape.name;
    EXPECT_LE(testkit::count_allocations() - before, text.size()) << shape.name;
  }
}

}  // namespace

}  // namespace asperity
