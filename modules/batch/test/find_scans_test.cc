#include "asperity/batch/find_scans.h"

#include <fstream>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

class FindScans : public testing::Test {
 protected:
  void add(const std::string& path) {
    fs::create_directories(dir_ / path);
    std::ofstream(dir_ / path / "recording.json") << "{}";
  }
  std::vector<std::string> names(const std::vector<std::string>& patterns) {
    std::vector<std::string> out;
    for (const BatchScan& scan : find_scans(dir_.path(), patterns)) out.push_back(scan.name);
    return out;
  }
  std::string fault(const std::vector<std::string>& patterns) {
    try {
      find_scans(dir_.path(), patterns);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  testkit::TempDir dir_;
};

TEST_F(FindScans, NamesArePathsBelowWhatAllShare) {
  add("day/s1/scan");
  add("day/s2/scan");
  fs::create_directories(dir_ / "day/s3/none");
  EXPECT_THAT(names({"day/*/scan"}), ElementsAre("s1/scan", "s2/scan"));
  EXPECT_THAT(names({"day/s1/scan"}), ElementsAre("scan"));
  EXPECT_THAT(names({(dir_ / "day/s2/*").string(), "day/s1/scan"}), ElementsAre("s1/scan", "s2/scan"));
  EXPECT_THAT(names({(dir_ / "day/*/scan").string(), "day/s1/scan", "day/s2/../s2/scan"}),
              ElementsAre("s1/scan", "s2/scan"))
      << "each once, by whatever path";
}

TEST_F(FindScans, StarsStandForFolders) {
  add("a/b/c/rec1");
  add("a/rec2");
  add("rec3");
  add(".hidden/rec4");
  EXPECT_THAT(names({"**"}), ElementsAre("a/b/c/rec1", "a/rec2", "rec3"));
  EXPECT_THAT(names({"**/rec[12]"}), ElementsAre("b/c/rec1", "rec2"));
  EXPECT_THAT(names({"*", "rec3", "rec?"}), ElementsAre("rec3"));
}

// A folder that links to the one above it has no end.
TEST_F(FindScans, LinksUpwardsEnd) {
  add("a/rec");
  fs::create_directory_symlink("..", dir_ / "a/up");
  EXPECT_THAT(names({"**"}), ElementsAre("rec"));
}

TEST_F(FindScans, WhatIsNotThereIsNamed) {
  add("a/rec");
  fs::create_directories(dir_ / "b");
  EXPECT_EQ(fault({"x*"}), "no recording matches 'x*'");
  EXPECT_EQ(fault({"b"}), "b: not a recording: recording.json is missing");
  add("a/rec/inner");
  EXPECT_EQ(fault({"**"}), "the recording 'rec/inner' is inside another recording of the batch");
}

TEST_F(FindScans, TwoThatWouldShareAFileAreRefused) {
  add("a-b/c");
  add("a/b-c");
  EXPECT_EQ(fault({"**"}), "two recordings would be called 'a-b-c'");
}

}  // namespace
}  // namespace asperity
