#include "asperity/studio/measured_metrics.h"

#include <gmock/gmock.h>

#include <set>

#include "asperity/json/parse_json.h"
#include "metric_rows.h"

namespace asperity::studio {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> keys(const Json& metrics) {
  std::vector<std::string> out;
  for (const Json& metric : metrics) out.push_back(metric["key"].text());
  return out;
}

TEST(MeasuredMetrics, HaveUnitAndError) {
  const Json metrics = measured_metrics(parse_json(
      R"({"length_m":0.08,"periodicity":{"periodic":true,"pitch_m":0.0025,"pitch_stderr_m":1e-6,"periods":3}})"));
  ASSERT_EQ(metrics.size(), 4U);
  EXPECT_EQ(metrics[0]["unit"], "mm");
  EXPECT_DOUBLE_EQ(metrics[0]["value"].get<double>(), 80.0);
  EXPECT_EQ(metrics[1]["value"], "yes");
  EXPECT_DOUBLE_EQ(metrics[2]["error"].get<double>(), 1e-3);
  EXPECT_EQ(metrics[3]["value"], 3);
  EXPECT_TRUE(metrics[3]["count"].get<bool>());
}

TEST(MeasuredMetrics, LeaveOutWhatMeansNothing) {
  const Json metrics = measured_metrics(parse_json(
      R"({"periodicity":{"periodic":false,"pitch_m":0.0025,"depth_m":1e-5,"strength":0.2,"periods":3},
          "stiffness":{"measured":false,"stiffness_N_per_mm":2,"lower_bound_N_per_mm":1.1,"verdict":""},
          "roughness":null})"));
  EXPECT_THAT(keys(metrics), ElementsAre("periodicity.periodic", "stiffness.lower_bound_N_per_mm"));
}

TEST(MeasuredMetrics, OfWhatCouldNotBeHadAreNull) {
  const Json metrics = measured_metrics(parse_json(R"({"roughness":{"Ra_m":null,"missing":null}})"));
  ASSERT_EQ(metrics.size(), 2U);
  EXPECT_TRUE(metrics[0]["value"].is_null());
  EXPECT_TRUE(metrics[1]["value"].is_null());
}

TEST(MeasuredMetrics, TakeAnyJson) {
  EXPECT_TRUE(measured_metrics(parse_json("[1]")).empty());
  EXPECT_TRUE(measured_metrics(parse_json(R"({"profile":7,"base":{"shape":3},"stiffness":[]})")).empty());
  const Json odd = measured_metrics(parse_json(R"({"length_m":"<b>","profile":{"gaps":{}}})"));
  for (const Json& metric : odd) EXPECT_TRUE(metric["value"].is_null()) << metric;
}

TEST(MeasuredMetrics, AreEachThereOnce) {
  std::set<std::string_view> all;
  for (const MetricGroup& group : metric_groups()) {
    std::set<std::string_view> labels;
    for (const MetricRow& row : group.rows) {
      EXPECT_TRUE(all.insert(row.key).second) << row.key;
      EXPECT_TRUE(labels.insert(row.label).second) << row.label;
    }
  }
}

}  // namespace
}  // namespace asperity::studio
