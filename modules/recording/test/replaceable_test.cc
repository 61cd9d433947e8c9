#include <gtest/gtest.h>

#include "asperity/base/output.h"
#include "asperity/recording/read_recording.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

std::string recording_json(const std::string& extra) {
  return R"({"format":"asperity-recording","version":1,"extra":)" + extra + "}";
}

TEST(Replaceable, OnlyWhatCanBeMadeAgain) {
  testkit::TempDir dir;
  write_file(dir / "recording.json", recording_json(R"({"simulation":{}})"));
  EXPECT_TRUE(is_replaceable_recording(dir.path()));
  write_file(dir / "recording.json", recording_json(R"({"imported":true})"));
  EXPECT_TRUE(is_replaceable_recording(dir.path()));
  write_file(dir / "recording.json", recording_json("{}"));  // measured
  EXPECT_FALSE(is_replaceable_recording(dir.path()));
}

TEST(Replaceable, NotWithSomebodysFileInIt) {
  testkit::TempDir dir;
  write_file(dir / "recording.json", recording_json(R"({"simulation":{}})"));
  write_file(dir / "notes.txt", "mine");
  EXPECT_FALSE(is_replaceable_recording(dir.path()));
}

}  // namespace
}  // namespace asperity
