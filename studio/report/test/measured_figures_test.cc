#include "asperity/studio/measured_figures.h"

#include <gmock/gmock.h>

#include <set>

#include "asperity/json/parse_json.h"
#include "figure_rows.h"

namespace asperity::studio {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> keys(const Json& figures) {
  std::vector<std::string> out;
  for (const Json& figure : figures) out.push_back(figure["key"].text());
  return out;
}

TEST(MeasuredFigures, HaveUnitAndError) {
  const Json figures = measured_figures(parse_json(
      R"({"length_m":0.08,"periodicity":{"periodic":true,"pitch_m":0.0025,"pitch_stderr_m":1e-6,"periods":3}})"));
  ASSERT_EQ(figures.size(), 4U);
  EXPECT_EQ(figures[0]["unit"], "mm");
  EXPECT_DOUBLE_EQ(figures[0]["value"].get<double>(), 80.0);
  EXPECT_EQ(figures[1]["value"], "yes");
  EXPECT_DOUBLE_EQ(figures[2]["error"].get<double>(), 1e-3);
  EXPECT_EQ(figures[3]["value"], 3);
  EXPECT_TRUE(figures[3]["count"].get<bool>());
}

TEST(MeasuredFigures, LeaveOutWhatMeansNothing) {
  const Json figures = measured_figures(parse_json(
      R"({"periodicity":{"periodic":false,"pitch_m":0.0025,"depth_m":1e-5,"strength":0.2,"periods":3},
          "stiffness":{"measured":false,"stiffness_N_per_mm":2,"lower_bound_N_per_mm":1.1,"verdict":""},
          "roughness":null})"));
  EXPECT_THAT(keys(figures), ElementsAre("periodicity.periodic", "stiffness.lower_bound_N_per_mm"));
}

TEST(MeasuredFigures, OfWhatCouldNotBeHadAreNull) {
  const Json figures = measured_figures(parse_json(R"({"roughness":{"Ra_m":null,"missing":null}})"));
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_TRUE(figures[0]["value"].is_null());
  EXPECT_TRUE(figures[1]["value"].is_null());
}

TEST(MeasuredFigures, TakeAnyJson) {
  EXPECT_TRUE(measured_figures(parse_json("[1]")).empty());
  EXPECT_TRUE(measured_figures(parse_json(R"({"profile":7,"base":{"shape":3},"stiffness":[]})")).empty());
  const Json odd = measured_figures(parse_json(R"({"length_m":"<b>","profile":{"gaps":{}}})"));
  for (const Json& figure : odd) EXPECT_TRUE(figure["value"].is_null()) << figure;
}

TEST(MeasuredFigures, AreEachThereOnce) {
  std::set<std::string_view> all;
  for (const FigureGroup& group : figure_groups()) {
    std::set<std::string_view> labels;
    for (const FigureRow& row : group.rows) {
      EXPECT_TRUE(all.insert(row.key).second) << row.key;
      EXPECT_TRUE(labels.insert(row.label).second) << row.label;
    }
  }
}

}  // namespace
}  // namespace asperity::studio
