// Many recordings through the same commands, as a user would: with a bad one among them, done again, by make.
#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/json/parse_json.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Batch : public testing::Test {
 protected:
  // Two scans of 40 mm and one whose stream was lost; the text is shared by all tests of this program.
  static void SetUpTestSuite() {
    dir_ = new testkit::TempDir;
    for (const char* seed : {"1", "2"}) {
      const Outcome made =
          run({"simulate", "--surface", "sandpaper", "--probe", "open", "--seed", seed, "--set", "hand.length_m=0.03",
               "-o", *dir_ / "scans" / ("s" + std::string(seed)) / "rec", "--quiet"});
      ASSERT_EQ(made.code, 0) << made.err;
    }
    fs::create_directories(*dir_ / "scans/s3");
    fs::copy(*dir_ / "scans/s1/rec", *dir_ / "scans/s3/rec", fs::copy_options::recursive);
    write_text(*dir_ / "scans/s3/rec/probe.csv", "");
    write_text(*dir_ / "plan.toml",
               "recordings = [\"scans/*/rec\"]\noutput = \"results\"\n[texture]\noptions = [\"--model\", "
               "\"stochastic\"]\n[roughness]\n");
  }
  static void TearDownTestSuite() {
    delete dir_;
    dir_ = nullptr;
  }
  static std::vector<std::string> lines(const fs::path& file) {
    std::vector<std::string> out;
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);) out.push_back(line);
    return out;
  }
  static testkit::TempDir* dir_;
};

testkit::TempDir* Batch::dir_ = nullptr;

TEST_F(Batch, GoesOnPastABadOneAndDoesNothingTwice) {
  const fs::path results = *dir_ / "results";
  const Outcome first = run({"batch", *dir_ / "plan.toml", "-j", "2"});
  EXPECT_EQ(first.code, 1) << "one of the three failed: " << first.err;
  EXPECT_THAT(first.err, HasSubstr("s3/rec: failed: process: "));
  EXPECT_THAT(first.out, HasSubstr("1 failed; 0 scans were up to date"));
  const auto summary = lines(results / "summary.csv");
  ASSERT_EQ(summary.size(), 4U);
  EXPECT_TRUE(summary[1].starts_with("s1/rec,scans/s1/rec,valid,")) << summary[1];
  EXPECT_TRUE(summary[3].starts_with("s3/rec,scans/s3/rec,failed,")) << summary[3];
  EXPECT_TRUE(fs::exists(results / "s1/rec/s1-rec.texture.json"));
  EXPECT_TRUE(fs::exists(results / "s2/rec/s2-rec.texture.json"));
  EXPECT_GT(parse_json(read_file(results / "s1/rec/s1-rec.roughness.json", 1 << 20))["roughness"]["Ra_m"].get<double>(),
            1e-7);
  EXPECT_THAT(read_file(results / "index.html", 1 << 20), HasSubstr("<a href=\"s1/rec/process/report.html\">"));

  const auto before = fs::last_write_time(results / "s1/rec/process");
  const Outcome again = run({"batch", *dir_ / "plan.toml", "--json"});
  EXPECT_EQ(again.code, 1);
  const Json told = parse_json(again.out);
  EXPECT_EQ(told["up_to_date"].get<int>(), 2);
  EXPECT_EQ(told["results"].size(), 3U);
  EXPECT_EQ(fs::last_write_time(results / "s1/rec/process"), before);
}

TEST_F(Batch, RefusesAFolderOfOthers) {
  const testkit::TempDir other;
  write_text(other / "mine.txt", "mine");
  const Outcome refused = run({"batch", *dir_ / "scans/s1/rec", "-o", other.path()});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("holds files that are not of a batch"));
  EXPECT_EQ(contents(other.path()).size(), 1U);
  EXPECT_EQ(run({"batch", *dir_ / "scans/none", "-o", *dir_ / "out"}).code, 1);
  EXPECT_EQ(run({"batch", *dir_ / "scans/s1/rec"}).code, 2) << "no folder of results is stated";
}

// GNU make does the same; a failed scan does not keep the others, and the summary lists it.
TEST_F(Batch, MakeDoesItsWorkflow) {
  const Outcome written = run({"batch", *dir_ / "plan.toml", "-o", *dir_ / "made", "--emit", "make"});
  ASSERT_EQ(written.code, 0) << written.err;
  const std::string make = "make -C " + (*dir_ / "workflow").string() + " -k ";
  const std::string log = " > " + (*dir_ / "make.log").string() + " 2>&1";
  EXPECT_NE(std::system((make + log).c_str()), 0) << "s3 fails";
  EXPECT_FALSE(fs::exists(*dir_ / "made/summary.csv"));
  EXPECT_FALSE(fs::exists(*dir_ / "made/s3/rec/batch.done"));
  EXPECT_NE(std::system((make + "summary" + log).c_str()), 0);
  const auto summary = lines(*dir_ / "made/summary.csv");
  ASSERT_EQ(summary.size(), 4U) << read_file(*dir_ / "make.log", 1 << 20);
  EXPECT_TRUE(summary[2].starts_with("s2/rec,scans/s2/rec,valid,")) << summary[2];
  EXPECT_THAT(summary[3], HasSubstr(",failed,,process,")) << "why it failed is kept for the summary";
  const auto before = fs::last_write_time(*dir_ / "made/s1/rec/batch.done");
  EXPECT_NE(std::system((make + log).c_str()), 0);
  EXPECT_EQ(fs::last_write_time(*dir_ / "made/s1/rec/batch.done"), before) << "it was up to date";
}

// Snakemake (Debian's 7.21) likewise.
TEST_F(Batch, SnakemakeDoesItsWorkflow) {
  ASSERT_EQ(std::system("command -v snakemake > /dev/null"), 0) << "scripts/bootstrap installs it";
  const fs::path flow = *dir_ / "snake";
  const Outcome written =
      run({"batch", *dir_ / "plan.toml", "-o", *dir_ / "snaked", "--emit", "snakemake", "--workflow", flow});
  ASSERT_EQ(written.code, 0) << written.err;
  // It keeps its own notes in the folder where it is started.
  const std::string snakemake = "cd " + dir_->path().string() + " && snakemake -s " + (flow / "Snakefile").string() +
                                " -j 2 --keep-going > " + (*dir_ / "snake.log").string() + " 2>&1";
  EXPECT_NE(std::system(snakemake.c_str()), 0) << "s3 fails";
  const auto summary = lines(*dir_ / "snaked/summary.csv");
  ASSERT_EQ(summary.size(), 4U) << read_file(*dir_ / "snake.log", 1 << 20);
  EXPECT_TRUE(summary[1].starts_with("s1/rec,scans/s1/rec,valid,")) << summary[1];
  EXPECT_THAT(summary[3], HasSubstr(",failed,,process,")) << "why it failed is kept for the summary";
  // What changes the plan's file and no step makes Snakemake begin each scan again; nothing is done twice.
  const auto before = fs::last_write_time(*dir_ / "snaked/s1/rec/process/result.json");
  fs::last_write_time(*dir_ / "plan.toml", fs::file_time_type::clock::now());
  EXPECT_NE(std::system(snakemake.c_str()), 0);
  EXPECT_EQ(fs::last_write_time(*dir_ / "snaked/s1/rec/process/result.json"), before);
}

// The summary alone goes into a folder of a batch only, and results are never among a recording's files.
TEST_F(Batch, LeavesOtherFoldersAlone) {
  const testkit::TempDir other;
  write_text(other / "summary.csv", "mine");
  const Outcome summary = run({"batch", *dir_ / "plan.toml", "-o", other.path(), "--summary"});
  EXPECT_EQ(summary.code, 1);
  EXPECT_THAT(summary.err, HasSubstr("holds files that are not of a batch"));
  EXPECT_EQ(run({"batch", *dir_ / "plan.toml", "-o", other.path(), "--scan", "s1/rec"}).code, 1);
  EXPECT_EQ(read_file(other / "summary.csv", 100), "mine");
  EXPECT_EQ(contents(other.path()).size(), 1U);
  const fs::path scan = *dir_ / "scans/s1/rec";
  const Outcome inside = run({"batch", scan, "-o", scan / "results"});
  EXPECT_EQ(inside.code, 1);
  EXPECT_THAT(inside.err, HasSubstr("cannot be inside the recording"));
  EXPECT_FALSE(fs::exists(scan / "results"));
}

// A scan that this run could not do is not reported with what an earlier one made of it.
TEST_F(Batch, AScanThatCannotBeDoneAgainHasFailed) {
  const fs::path scan = *dir_ / "again/rec", out = *dir_ / "blocked";
  fs::create_directories(*dir_ / "again");
  fs::copy(*dir_ / "scans/s1/rec", scan, fs::copy_options::recursive);
  ASSERT_EQ(run({"batch", scan, "-o", out}).code, 0);
  fs::last_write_time(scan / "probe.csv", fs::last_write_time(scan / "probe.csv") + std::chrono::seconds(1));
  fs::remove(out / "rec/process.log");
  fs::create_directories(out / "rec/process.log");
  const Outcome failed = run({"batch", scan, "-o", out});
  EXPECT_EQ(failed.code, 1) << failed.out;
  EXPECT_THAT(failed.err, HasSubstr("process.log"));
}

}  // namespace
}  // namespace asperity::cli
