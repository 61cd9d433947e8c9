#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "feel_fixture.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Json = nlohmann::json;

// A driver of the vendor's kind, loaded as the vendor's is; unplugged after so many forces, if that is not negative.
struct FakeDriver {
  explicit FakeDriver(int unplug_after) { ::setenv("FAKE_DHD_UNPLUG_AFTER", std::to_string(unplug_after).c_str(), 1); }
  ~FakeDriver() { ::unsetenv("FAKE_DHD_UNPLUG_AFTER"); }
  const std::string setting = std::string("dhd.library=") + FAKE_DHD;
};

TEST_F(FeelCommands, AHandAtADeviceIsServedByTheClock) {
  const FakeDriver driver(-1);
  const Outcome outcome = feel(path("scene"), {"--device", "dhd", "--set", driver.setting, "--duration", "300ms",
                                               "--log", path("log.csv"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_TRUE(json.at("timing").contains("overruns"));
  // The device's origin stands in the middle of the plate.
  EXPECT_NEAR(json.at("config").at("servo").at("frame").at("translation_m").at(0).get<double>(), 0.03, 1e-12);
  // A texture spring of 1 N/mm is beyond what 1 kHz can render (Choi and Tan).
  EXPECT_THAT(json.at("warnings").dump(), HasSubstr("texture"));
  EXPECT_GT(read_table(path("log.csv")).rows.size(), 50u);
}

TEST_F(FeelCommands, AFaultEndsWith3AndAFlightRecord) {
  const FakeDriver driver(100);
  const Outcome outcome = feel(path("scene"), {"--device", "dhd", "--set", driver.setting, "--duration", "20s", "--log",
                                               path("log.csv"), "--json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("the device has a fault"));
  EXPECT_EQ(Json::parse(outcome.out).at("end"), "fault");
  EXPECT_FALSE(Json::parse(outcome.out).at("trustworthy").get<bool>());
  EXPECT_TRUE(fs::exists(path("log.csv")));
  const Table flight = read_header(path("log.flight.csv"));
  EXPECT_THAT(flight.columns, ::testing::Contains("t_ns"));
}

TEST_F(FeelCommands, AMissingDriverIsNamed) {
  const Outcome outcome = feel(path("scene"), {"--device", "dhd", "--set", "dhd.library=" + path("none.so")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("none.so"));
}

}  // namespace
}  // namespace asperity::cli
