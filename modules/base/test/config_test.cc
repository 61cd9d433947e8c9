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
    v.former("cutoff");
    v.former("corner_hz");
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

// The groups before a name differ between functions: render.NAME of a command is NAME of the renderer's own settings.
TEST(Config, SuggestsTheSameNameInOtherGroups) {
  Outer config;
  const auto message = [](const std::vector<ConfigField>& fields, const char* path) -> std::string {
    try {
      set_field(fields, path, "1");
    } catch (const UnknownSetting& error) {
      EXPECT_EQ(error.suggests(), std::string(error.what()).find("did you mean") != std::string::npos) << path;
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(list_fields("", config), "long_group_name.inner.count"),
            "unknown setting 'long_group_name.inner.count'; did you mean 'inner.count'?");
  EXPECT_EQ(message(list_fields("long_group_name", config), "inner.count"),
            "unknown setting 'inner.count'; did you mean 'long_group_name.inner.count'?");
  EXPECT_EQ(message(list_fields("", config), "wurst"), "unknown setting 'wurst'");
}

// A settings file, a --set or a project of an older version.
TEST(Config, ReadsFormerNamesAndWritesTheNewOne) {
  Outer config;
  const auto fields = list_fields("stage", config);
  set_field(fields, "stage.cutoff", "2.5");
  EXPECT_EQ(config.cutoff_Hz, 2.5);
  find_field(fields, "stage.corner_hz").set(3.5);
  EXPECT_EQ(config.cutoff_Hz, 3.5);
  EXPECT_EQ(find_field(fields, "stage.cutoff").path, "stage.cutoff_Hz");
  EXPECT_THAT(to_toml(fields, true), testing::Not(testing::HasSubstr("corner_hz")));
  // The range is that of the field, and a group's former names are that group's.
  EXPECT_THROW(set_field(fields, "stage.cutoff", "101"), Error);
  EXPECT_THROW(set_field(fields, "cutoff", "2"), Error);
  EXPECT_THROW(set_field(fields, "stage.inner.cutoff", "2"), Error);
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
  EXPECT_EQ(toml_text(list_fields("", config).front().get()), R"("a\u0009b\u000a\"c\"\\\u007f")");
}

TEST(Config, HoldsTypedValues) {
  Outer config;
  const auto fields = list_fields("", config);
  EXPECT_EQ(find_field(fields, "cutoff_Hz").get(), ConfigValue(0.5));
  EXPECT_EQ(find_field(fields, "colour").get(), ConfigValue("red"));
  EXPECT_EQ(find_field(fields, "sigma_m").get(), ConfigValue(std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(find_field(fields, "inner.count").get(), ConfigValue(std::int64_t{3}));
  find_field(fields, "cutoff_Hz").set(std::int64_t{12});
  find_field(fields, "colour").set("blue");
  find_field(fields, "sigma_m").set(std::vector<double>{4.0, 5.0, 6.0});
  find_field(fields, "inner.count").set(std::int64_t{7});
  EXPECT_EQ(config.cutoff_Hz, 12.0);
  EXPECT_EQ(config.colour, Colour::kBlue);
  EXPECT_EQ(config.sigma_m[1], 5.0);
  EXPECT_EQ(config.inner.count, 7);
}

TEST(Config, RefusesValuesOfAnotherType) {
  Outer config;
  const auto fields = list_fields("", config);
  EXPECT_THAT([&] { find_field(fields, "cutoff_Hz").set("5"); },
              testing::ThrowsMessage<Error>("cutoff_Hz: '\"5\"' is not a number from 0 to 100"));
  EXPECT_THAT([&] { find_field(fields, "inner.count").set(5.0); },
              testing::ThrowsMessage<Error>("inner.count: '5.0' is not a whole number from 0 to 10"));
  EXPECT_THROW(find_field(fields, "inner.count").set(true), Error);
  EXPECT_THROW(find_field(fields, "sigma_m").set(1.0), Error);
  EXPECT_THROW(find_field(fields, "colour").set("green"), Error);
  EXPECT_TRUE(is_same_config(config, Outer()));
}

TEST(Config, WritesToml) {
  Outer config;
  EXPECT_EQ(to_toml(list_fields("stage", config), false),
            "[stage]\ncutoff_Hz = 0.5\ncolour = \"red\"\nsigma_m = [1.0, 2.0, 3.0]\n\n[stage.inner]\ncount = 3\n");
}

}  // namespace
}  // namespace asperity
