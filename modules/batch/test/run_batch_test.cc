// The steps are done by a script in asperity's place, which writes down each call.
#include "asperity/batch/run_batch.h"

#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;

// process: fails for a recording with a file `bad`, ends with 3 for one with `doubtful`, waits for ever at `hangs`.
constexpr const char* kProgram = R"(#!/bin/sh
echo "$1 $2" >> calls
rec=$2
if [ "$1" = process ]; then
  [ -e "$rec/hangs" ] && { echo begun >> begun; exec sleep 60; }
  [ -e "$rec/bad" ] && { echo "asperity: $rec: line 3 is bad" >&2; exit 1; }
  mkdir -p "$4" && echo '{}' > "$4/result.json" && echo h > "$4/profile.csv"
  [ -e "$rec/doubtful" ] && exit 3
  exit 0
fi
[ "$1" = register ] && { mkdir -p "$5"; exit 3; }
[ "$1" = roughness ] && { echo '{"Ra_m":1}'; exit 0; }
exit 0
)";

class RunBatch : public testing::Test {
 protected:
  RunBatch() {
    write_file(dir_ / "program", kProgram);
    ::chmod((dir_ / "program").c_str(), 0755);
    plan_.folder = dir_.path();
    plan_.recordings = {"scans/*"};
    plan_.roughness = BatchOptions{};
    for (const char* name : {"a", "b", "c"}) {
      fs::create_directories(dir_ / "scans" / name);
      write_file(dir_ / "scans" / name / "recording.json", "{}");
    }
  }
  std::vector<ScanOutcome> run(int jobs, const Observer& observer = {}) {
    return run_batch(plan_, find_scans(plan_.folder, plan_.recordings), "out", dir_ / "program", jobs, observer, {});
  }
  std::size_t calls() {
    std::size_t count = 0;
    std::ifstream file(dir_ / "calls");
    for (std::string line; std::getline(file, line);) ++count;
    return count;
  }
  testkit::TempDir dir_;
  BatchPlan plan_;
};

TEST_F(RunBatch, DoesEachOnceAndThenOnlyWhatChanged) {
  auto outcomes = run(2);
  ASSERT_EQ(outcomes.size(), 3U);
  for (const ScanOutcome& one : outcomes) {
    EXPECT_FALSE(one.was_up_to_date);
    ASSERT_EQ(one.record.steps.size(), 2U);
    EXPECT_EQ(one.record.steps[1].exit_code, 0) << one.record.steps[1].message;
  }
  EXPECT_EQ(read_file(dir_ / "out/a/a.roughness.json", 100), "{\"Ra_m\":1}\n");
  EXPECT_EQ(calls(), 6U);
  for (const ScanOutcome& one : run(2)) EXPECT_TRUE(one.was_up_to_date);
  EXPECT_EQ(calls(), 6U);
  write_file(dir_ / "scans/b/probe.csv", "new");
  outcomes = run(1);
  EXPECT_TRUE(outcomes[0].was_up_to_date);
  EXPECT_FALSE(outcomes[1].was_up_to_date);
  EXPECT_EQ(calls(), 8U);
  plan_.process.words = {"--quiet-not"};  // other words: process again, and the roughness of its new files
  run(1);
  EXPECT_EQ(calls(), 14U);
}

TEST_F(RunBatch, GoesOnPastFailures) {
  write_file(dir_ / "scans/a/bad", "");
  write_file(dir_ / "scans/b/doubtful", "");
  const auto outcomes = run(1);
  ASSERT_EQ(outcomes[0].record.steps.size(), 1U);
  EXPECT_EQ(outcomes[0].record.steps[0].exit_code, 1);
  EXPECT_EQ(outcomes[0].record.steps[0].message, "scans/a: line 3 is bad");
  ASSERT_EQ(outcomes[1].record.steps.size(), 2U);
  EXPECT_EQ(outcomes[1].record.steps[0].exit_code, 3);
  EXPECT_EQ(outcomes[2].record.steps.size(), 2U);
  fs::remove(dir_ / "scans/a/bad");
  const auto again = run(1);
  EXPECT_EQ(again[0].record.steps.size(), 2U);
  EXPECT_TRUE(again[1].was_up_to_date);
}

TEST_F(RunBatch, AFileThatAnOptionNamesIsAnInput) {
  write_file(dir_ / "settings.toml", "");
  plan_.process.words = {"--config=settings.toml"};
  run(1);
  for (const ScanOutcome& one : run(1)) EXPECT_TRUE(one.was_up_to_date);
  write_file(dir_ / "settings.toml", "method = \"thesis\"\n");
  for (const ScanOutcome& one : run(1)) EXPECT_FALSE(one.was_up_to_date);
}

// A step that is done again is followed by one that is up to date: the file has both.
TEST_F(RunBatch, TheRecordHasAllStepsOfThePlanAndNoOthers) {
  plan_.registration = BatchOptions{};
  plan_.mesh = "m.obj";
  run(1);
  plan_.roughness->words = {"--more"};
  const auto outcomes = run(1);
  ASSERT_EQ(outcomes[0].record.steps.size(), 3U);
  EXPECT_EQ(read_scan_record(dir_ / "out/a/batch.json").steps.size(), 3U) << "register ended with 3, which counts";
  for (const ScanOutcome& one : run(1)) EXPECT_TRUE(one.was_up_to_date);
  plan_.registration.reset();
  run(1);
  EXPECT_EQ(read_scan_record(dir_ / "out/a/batch.json").steps.size(), 2U);
}

TEST_F(RunBatch, AProgramThatIsNotThereFailsEachScan) {
  fs::remove(dir_ / "program");
  for (const ScanOutcome& one : run(2)) {
    ASSERT_EQ(one.record.steps.size(), 1U);
    EXPECT_NE(one.record.steps[0].message.find("cannot be started"), std::string::npos) << one.record.steps[0].message;
  }
}

// Stopped while `b` runs: `a` stays done, and the next call goes on.
TEST_F(RunBatch, GoesOnWhereItWasStopped) {
  write_file(dir_ / "scans/b/hangs", "");
  Observer observer;
  observer.cancelled = [&] { return fs::exists(dir_ / "begun"); };
  EXPECT_THROW(run(1, observer), Cancelled);
  fs::remove(dir_ / "scans/b/hangs");
  const auto outcomes = run(1);
  EXPECT_TRUE(outcomes[0].was_up_to_date);
  EXPECT_FALSE(outcomes[1].was_up_to_date);
  EXPECT_EQ(outcomes[2].record.steps.size(), 2U);
}

}  // namespace
}  // namespace asperity
