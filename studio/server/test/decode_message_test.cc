#include <gmock/gmock.h>

#include <cstring>
#include <limits>
#include <string>

#include "asperity/base/error.h"
#include "asperity/studio/message.h"
#include "asperity/testkit/count_allocations.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;

std::string refused(const std::string& frame, bool is_text = true) {
  try {
    decode_message(frame, is_text);
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string out;
  for (std::size_t i = 0; i < times; ++i) out += text;
  return out;
}

std::string pointer(std::uint32_t sequence, double x, double y, double z) {
  std::string out = "ASP1" + std::string(28, '\0');
  const double p[] = {x, y, z};
  std::memcpy(out.data() + 4, &sequence, 4);
  std::memcpy(out.data() + 8, p, sizeof p);
  return out;
}

TEST(DecodeMessage, TakesCalls) {
  const auto call =
      std::get<Call>(decode_message(R"({"id":7,"call":"scan.start_2","args":{"b":1,"a":"ü\u0000"}})", true));
  EXPECT_EQ(call.id, 7U);
  EXPECT_EQ(call.name, "scan.start_2");
  EXPECT_EQ(call.args.dump(), R"({"b":1,"a":"ü\u0000"})");
  EXPECT_TRUE(std::get<Call>(decode_message(R"( {"call":"x","id":0} )", true)).args.empty());
  EXPECT_EQ(std::get<Call>(decode_message(R"({"id":9007199254740992,"call":"x"})", true)).id, std::uint64_t{1} << 53);
  EXPECT_EQ(std::get<Call>(decode_message(R"({"id":1,"call":")" + std::string(64, 'x') + "\"}", true)).name.size(),
            64U);
}

TEST(DecodeMessage, RefusesOtherText) {
  EXPECT_THAT(refused(""), HasSubstr("not JSON"));
  EXPECT_THAT(refused(R"({"id":7,"call":"x"} x)"), HasSubstr("not JSON"));
  EXPECT_THAT(refused("{\"id\":7,\"call\":\"x\xFF\"}"), HasSubstr("not UTF-8"));
  EXPECT_THAT(refused(R"({"id":7,"call":"x","args":{"a":"\ud800"}})"), HasSubstr("not JSON"));
  EXPECT_THAT(refused(R"({"id":7,"call":"x","args":{"a":NaN}})"), HasSubstr("not JSON"));
  EXPECT_THAT(refused(R"({"id":7,"call":"x","args":{"a":1e999}})"), HasSubstr("number overflow"));
  EXPECT_THAT(refused("[]"), HasSubstr("not an object"));
  EXPECT_THAT(refused("7"), HasSubstr("not an object"));
  EXPECT_THAT(refused(R"({"id":7})"), HasSubstr("no 'call'"));
  EXPECT_THAT(refused(R"({"call":"x"})"), HasSubstr("no 'id'"));
  EXPECT_THAT(refused(R"({"id":7,"call":"x","arg":{}})"), HasSubstr("unknown key 'arg'"));
  EXPECT_THAT(refused(R"({"id":7,"call":"x","args":[]})"), HasSubstr("args are not an object"));
  EXPECT_THAT(refused(R"({"id":7,"id":7,"call":"x"})"), HasSubstr("a message:1:9: key 'id' appears twice"));
  EXPECT_THAT(refused(R"({"id":7,"call":"x","args":{"a":[{"b":1,"b":2}]}})"),
              HasSubstr("key 'args.a[0].b' appears twice"));
  for (const char* id : {"-1", "7.0", "9007199254740993", "1e3", "\"7\"", "null", "18446744073709551616"}) {
    EXPECT_THAT(refused(std::string(R"({"call":"x","id":)") + id + "}"), HasSubstr("not a whole number")) << id;
  }
  for (const std::string& name :
       {std::string(), std::string("Scan"), std::string("a b"), std::string("a/b"), std::string(65, 'x')}) {
    EXPECT_THAT(refused(R"({"id":7,"call":")" + name + "\"}"), HasSubstr("not a name")) << name;
  }
  EXPECT_THAT(refused(R"({"id":7,"call":7})"), HasSubstr("not a name"));
}

TEST(DecodeMessage, BoundsLengthDepthAndKeys) {
  const auto nested = [](std::size_t arrays) {
    return R"({"id":7,"call":"x","args":{"a":)" + std::string(arrays, '[') + std::string(arrays, ']') + "}}";
  };
  EXPECT_EQ(refused(nested(kMaxMessageDepth - 2)), "taken");
  EXPECT_THAT(refused(nested(kMaxMessageDepth - 1)), HasSubstr("nested more than 32 deep"));
  EXPECT_THAT(refused(std::string(kMaxMessageBytes, '[')), HasSubstr("nested more than 32 deep"));
  EXPECT_THAT(refused(repeated(R"({"a":)", 100'000)), HasSubstr("nested more than 32 deep"));
  std::string longest = R"({"id":7,"call":"x"})";
  longest.resize(kMaxMessageBytes, ' ');
  EXPECT_EQ(refused(longest), "taken");
  EXPECT_THAT(refused(longest + ' '), HasSubstr("1048577 bytes"));
  const auto keys = [](std::size_t count) {
    std::string args;
    for (std::size_t i = 0; i < count; ++i) args += (i > 0 ? ",\"" : "\"") + std::to_string(i) + "\":0";
    return R"({"id":7,"call":"x","args":{)" + args + "}}";
  };
  EXPECT_EQ(refused(keys(kMaxMessageKeys)), "taken");
  EXPECT_THAT(refused(keys(kMaxMessageKeys + 1)), HasSubstr("more than 1000 keys"));
  // The message, its id and name, args and the array are five more.
  const auto values = [](std::size_t count) {
    return R"({"id":7,"call":"x","args":{"a":[0)" + repeated(",0", count - 6) + "]}}";
  };
  EXPECT_EQ(refused(values(kMaxMessageValues)), "taken");
  EXPECT_THAT(refused(values(kMaxMessageValues + 1)), HasSubstr("more than 200000 values"));
  EXPECT_THAT(refused(R"({"id":7,"call":"x","args":{"a":[[])" + repeated(",[]", kMaxMessageValues) + "]}}"),
              HasSubstr("more than 200000 values"));
}

// What once kept the server busy for 24 s: each object is built once and none is looked through again.
TEST(DecodeMessage, WorkIsLinearInTheSize) {
  const auto allocations = [](std::size_t objects) {
    const std::string text = R"({"id":7,"call":"x","args":{"a":[{})" + repeated(",{}", objects - 1) + "]}}";
    const std::size_t before = testkit::count_allocations();
    EXPECT_EQ(std::get<Call>(decode_message(text, true)).args["a"].size(), objects);
    return static_cast<double>(testkit::count_allocations() - before);
  };
  const double most = allocations(199'000);
  EXPECT_LT(most, 4.0 * 199'000);
  EXPECT_LT(most, 2.05 * allocations(99'500));
}

TEST(DecodeMessage, TakesPointersAlone) {
  const auto taken = std::get<Pointer>(decode_message(pointer(4'000'000'000U, 0.1, -0.2, 1e-300), false));
  EXPECT_EQ(taken.sequence, 4'000'000'000U);
  EXPECT_THAT(taken.p_world_m, testing::ElementsAre(0.1, -0.2, 1e-300));
  const std::string good = pointer(1, 0, 0, 0);
  EXPECT_THAT(refused("", false), HasSubstr("0 bytes"));
  EXPECT_THAT(refused(good.substr(1), false), HasSubstr("31 bytes"));
  EXPECT_THAT(refused(good + "x", false), HasSubstr("33 bytes"));
  EXPECT_THAT(refused("ASP2" + good.substr(4), false), HasSubstr("not a pointer of this version"));
  EXPECT_THAT(refused(pointer(1, 0, std::numeric_limits<double>::quiet_NaN(), 0), false), HasSubstr("not finite"));
  EXPECT_THAT(refused(pointer(1, 0, 0, std::numeric_limits<double>::infinity()), false), HasSubstr("not finite"));
}

}  // namespace
}  // namespace asperity::studio
