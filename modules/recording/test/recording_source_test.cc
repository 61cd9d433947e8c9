#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/recording/recording_source.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using testing::HasSubstr;

std::string recording_json(const std::string& extra) {
  return R"({"format":"asperity-recording","version":1,"extra":)" + extra + "}";
}

std::string imported(const std::string& files) {
  return recording_json(R"({"imported":true,"import_origin":{"files":[)" + files + "]}}");
}

class ReplacedBy : public testing::Test {
 protected:
  void write(const std::string& json) { write_file(dir_ / "recording.json", json); }
  bool by(RecordingSource source) { return replaceable_by(std::move(source))(dir_.path()); }
  std::string error_by(RecordingSource source) {
    try {
      by(std::move(source));
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  testkit::TempDir dir_;
  const RecordingSource simulation_{RecordingKind::kSimulated, {}};
  const RecordingSource import_{RecordingKind::kImported, {"pose.csv 00000001", "imu.csv 00000002"}};
};

TEST_F(ReplacedBy, ASimulationReplacesSimulationsOnly) {
  write(recording_json(R"({"simulation":{}})"));
  EXPECT_TRUE(by(simulation_));
  EXPECT_THAT(error_by(import_),
              HasSubstr("holds a simulated recording, which is replaced only by another simulation"));
  EXPECT_THAT(error_by({}), HasSubstr("nothing was changed. Choose another output folder"));
  write(recording_json("{}"));
  EXPECT_THAT(error_by(simulation_), HasSubstr("holds a measured recording"));
  EXPECT_THAT(error_by({}), HasSubstr("holds a measured recording"));
}

TEST_F(ReplacedBy, AnImportReplacesOneOfTheSameFiles) {
  const std::string pose = R"({"role":"poses","file":"pose.csv","crc32":"00000001"})";
  write(imported(pose));
  EXPECT_TRUE(by(import_));
  EXPECT_THAT(error_by(simulation_),
              HasSubstr(dir_.path().string() + ": holds a recording that was imported from pose.csv"));
  write(imported(pose + R"(,{"role":"force","file":"force.csv","crc32":"00000003"})"));
  EXPECT_THAT(error_by(import_),
              HasSubstr("imported from pose.csv, force.csv, which is replaced only by an import of"));
  write(imported(R"({"role":"poses","file":"pose.csv","crc32":"00000009"})"));  // the same name, another content
  EXPECT_THAT(error_by(import_), HasSubstr("the same files, unchanged"));
  write(recording_json(R"({"imported":true})"));  // of an older version
  EXPECT_THAT(error_by(import_), HasSubstr("files that it does not name"));
}

TEST_F(ReplacedBy, OtherFoldersAreNot) {
  EXPECT_FALSE(by(simulation_));
  write(recording_json(R"({"simulation":{}})"));
  write_file(dir_ / "notes.txt", "mine");
  EXPECT_FALSE(by(simulation_));
}

}  // namespace
}  // namespace asperity
