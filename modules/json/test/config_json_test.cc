#include "asperity/json/config_json.h"

#include <gtest/gtest.h>
#include <array>
#include <limits>

namespace asperity {
namespace {

enum class Shade { kLight, kDark };
constexpr std::array<std::string_view, 2> kShadeNames{"light", "dark"};

struct Inner {
  std::array<double, 2> pair{1.0, -2.5};
  Shade shade = Shade::kDark;
  template <class V>
  void visit(V& v) {
    v.field("pair", pair, "");
    v.choice("shade", shade, kShadeNames, "");
  }
};

struct Outer {
  double length_m = 1e-7;
  double open = std::numeric_limits<double>::infinity();
  bool on = true;
  int count = 3;
  std::string name = "a \"b\"\\";
  Inner inner;
  template <class V>
  void visit(V& v) {
    v.field("length_m", length_m, "");
    v.field("open", open, "");
    v.field("on", on, "");
    v.group("inner", inner);
    v.field("count", count, "");
    v.field("name", name, "");
  }
};

TEST(ConfigJson, KeepsTypesOrderAndGroups) {
  Outer config;
  EXPECT_EQ(config_json(list_fields("", config)).dump(2),
            R"({
  "length_m": 1e-07,
  "open": "inf",
  "on": true,
  "inner": {
    "pair": [
      1.0,
      -2.5
    ],
    "shade": "dark"
  },
  "count": 3,
  "name": "a \"b\"\\"
})");
}

}  // namespace
}  // namespace asperity
