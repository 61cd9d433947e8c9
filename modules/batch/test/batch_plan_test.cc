#include "asperity/batch/batch_plan.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using testing::ElementsAre;

TEST(BatchPlan, ReadsAllSteps) {
  const BatchPlan plan = parse_batch_plan(R"(recordings = ["scans/*", "more/**/rec"]
output = "results"
[process]
options = ["--method", "thesis"]
[texture]
[register]
mesh = "pebble.obj"
options = ["--mesh-unit", "mm"]
)",
                                          "plan.toml");
  EXPECT_THAT(plan.recordings, ElementsAre("scans/*", "more/**/rec"));
  EXPECT_EQ(plan.output, "results");
  EXPECT_THAT(plan.process.words, ElementsAre("--method", "thesis"));
  ASSERT_TRUE(plan.texture);
  EXPECT_TRUE(plan.texture->words.empty());
  ASSERT_TRUE(plan.registration);
  EXPECT_EQ(plan.mesh, "pebble.obj");
  EXPECT_THAT(plan.registration->words, ElementsAre("--mesh-unit", "mm"));
  EXPECT_FALSE(plan.roughness);
}

TEST(BatchPlan, OptionsNameFilesBehindAnEqualsSignToo) {
  const BatchOptions options{{"--config", "a.toml", "--texture=b=c.json", "--json=", "-"}};
  EXPECT_THAT(options.possible_paths(), ElementsAre("a.toml", "b=c.json"));
}

std::string fault_of(const std::string& text) {
  try {
    parse_batch_plan(text, "plan.toml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(BatchPlan, FaultsNameTheFileAndTheLine) {
  EXPECT_EQ(fault_of("recordings = [\"a\"]\nspeed = 3\n"), "plan.toml:2: a plan has no speed");
  EXPECT_EQ(fault_of("recordings = \"a\"\n"), "plan.toml:1: recordings must be a list of texts");
  EXPECT_EQ(fault_of("recordings = [\"a\", 3]\n"), "plan.toml:1: recordings must be a text");
  EXPECT_EQ(fault_of("output = \"a\"\n"), "plan.toml: recordings is missing or empty");
  EXPECT_EQ(fault_of("recordings = [\"a\"]\n[process]\noptions = [\"-o\", \"x\"]\n"),
            "plan.toml:3: '-o' is set by batch itself");
  EXPECT_EQ(fault_of("recordings = [\"a\"]\n[process]\noptions = [\"-oout\"]\n"),
            "plan.toml:3: '-oout' is set by batch itself");
  EXPECT_EQ(fault_of("recordings = [\"a\"]\n[register]\noptions = []\n"), "plan.toml:2: register.mesh is missing");
  EXPECT_EQ(fault_of("recordings = [\"a\"]\n[process]\nmesh = \"m\"\n"), "plan.toml:3: a plan has no process.mesh");
  EXPECT_EQ(fault_of("recordings = [").substr(0, 12), "plan.toml:1:");
}

}  // namespace
}  // namespace asperity
