#include "asperity/batch/make_workflow.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/json/parse_json.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;

class MakeWorkflow : public testing::Test {
 protected:
  MakeWorkflow() {
    fs::create_directories(dir_ / "scans/a");
    write_file(dir_ / "scans/a/recording.json", "{}");
    write_file(dir_ / "scans/a/probe.csv", "");
    write_file(dir_ / "plan.toml", "");
    input_.plan.folder = dir_.path();
    input_.plan.mesh = "m.obj";
    input_.plan.registration = BatchOptions{};
    input_.plan_file = "plan.toml";
    input_.output = "out";
    input_.folder_from_it = "..";
    input_.program = "/opt/asperity";
    input_.scans = {{"a", "scans/a"}};
  }
  testkit::TempDir dir_;
  WorkflowInput input_;
};

TEST_F(MakeWorkflow, SnakemakeKnowsEachScansFiles) {
  const auto files = make_snakemake_workflow(input_);
  ASSERT_EQ(files.size(), 4U);
  EXPECT_EQ(files[1].name, "scans.json");
  const Json batch = parse_json(files[1].content);
  EXPECT_EQ(batch["scans"][0]["name"].text(), "a");
  EXPECT_EQ(batch["scans"][0]["inputs"].get<std::vector<std::string>>(),
            (std::vector<std::string>{"scans/a/probe.csv", "scans/a/recording.json"}));
  EXPECT_EQ(batch["inputs"].get<std::vector<std::string>>(), (std::vector<std::string>{"m.obj", "plan.toml"}));
  EXPECT_TRUE(files[3].is_program);
}

TEST_F(MakeWorkflow, MakeRefusesPathsThatItCannotTake) {
  EXPECT_NE(make_make_workflow(input_)[0].content.find(
                "../out/a/batch.done: ../scans/a/probe.csv ../scans/a/recording.json $(COMMON)\n"),
            std::string::npos);
  for (const char* name : {"a b", "~a", "-a", "a{b}"}) {
    input_.scans[0].name = name;
    EXPECT_THROW(make_make_workflow(input_), Error) << name;
  }
}

TEST_F(MakeWorkflow, SnakemakeRefusesBraces) {
  for (const char* name : {"a b", "~a", "-a", "$a'\""}) {
    input_.scans[0].name = name;
    EXPECT_NO_THROW(make_snakemake_workflow(input_)) << name;
  }
  input_.scans[0].name = "a{b}";
  EXPECT_THROW(make_snakemake_workflow(input_), Error);
}

}  // namespace
}  // namespace asperity
