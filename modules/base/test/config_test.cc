#include "asperity/base/config.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

enum class Colour { kRed, kBlue };
constexpr std::array<std::string_view, 2> kColourNames{"red", "blue"};

struct Inner {
  int count = 3;
  template <class V>
  void visit(V& v) {
    v.field("count", count, "how many", {0, 10});
  }
};

struct Outer {
  double cutoff_Hz = 0.5;
  Colour colour = Colour::kRed;
  std::array<double, 3> sigma_m{1.0, 2.0, 3.0};
  Inner inner;
  template <class V>
  void visit(V& v) {
    v.field("cutoff_Hz", cutoff_Hz, "low-pass", {0, 100});
    v.choice("colour", colour, kColourNames, "which");
    v.field("sigma_m", sigma_m, "noise");
    v.group("inner", inner);
  }
};

TEST(Config, SetsByPath) {
  Outer config;
  const auto fields = list_fields("stage", config);
  set_field(fields, "stage.cutoff_Hz", "12.5");
  set_field(fields, "stage.colour", "blue");
  set_field(fields, "stage.sigma_m", "[4, 5,6]");
  set_field(fields, "stage.inner.count", "7");
  EXPECT_EQ(config.cutoff_Hz, 12.5);
  EXPECT_EQ(config.colour, Colour::kBlue);
  EXPECT_EQ(config.sigma_m[2], 6.0);
  EXPECT_EQ(config.inner.count, 7);
}

TEST(Config, RefusesWithPathAndValue) {
  Outer config;
  const auto fields = list_fields("stage", config);
  EXPECT_THAT([&] { set_field(fields, "stage.cutof_Hz", "1"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("did you mean 'stage.cutoff_Hz'")));
  EXPECT_THAT([&] { set_field(fields, "stage.cutoff_Hz", "nan"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("'nan'")));
  EXPECT_THROW(set_field(fields, "stage.inner.count", "11"), Error);
  EXPECT_THROW(set_field(fields, "stage.colour", "green"), Error);
  EXPECT_THROW(set_field(fields, "stage.sigma_m", "1,2"), Error);
  EXPECT_EQ(config.cutoff_Hz, 0.5);
}

TEST(Config, TextsAreStringsOfTomlAndOfJson) {
  struct {
    std::string file = "a\tb\n\"c\"\\\x7F";
    void visit(ConfigLister& v) { v.field("file", file, "any"); }
  } config;
  EXPECT_EQ(list_fields("", config).front().get(), R"("a\u0009b\u000a\"c\"\\\u007f")");
}

TEST(Config, WritesToml) {
  Outer config;
  EXPECT_EQ(to_toml(list_fields("stage", config), false),
            "[stage]\ncutoff_Hz = 0.5\ncolour = \"red\"\nsigma_m = [1.0, 2.0, 3.0]\n\n[stage.inner]\ncount = 3\n");
}

}  // namespace
}  // namespace asperity
