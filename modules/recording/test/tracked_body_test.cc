#include "asperity/recording/tracked_body.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/recording/cut_recording.h"
#include "asperity/recording/import_imu_pose.h"
#include "asperity/recording/parse_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/recording_appender.h"
#include "asperity/recording/recover_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "random_recording.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int kPoses = 2000;  // some 100 KiB: two blocks of checksums

std::string body_text_of(const fs::path& path) { return read_file(path, 1 << 24); }

TrackerSample body_pose(int i) {
  TrackerSample out;
  out.t_ns = 10'000'000 * std::int64_t{i};
  out.T_world_marker.translation_m = {0.001 * i, 1.0 / 3.0, 0.25};
  return out;
}

RecordingInfo info_with_object() {
  RecordingInfo info;
  info.bodies = {{"object", {7, 9}}};
  return info;
}

// A recording of a probe and an object; the object's poses come half a frame later.
void record_with_object(const fs::path& folder, RecordingInfo info = info_with_object(), bool only_segments = false) {
  Random random(1);
  RecordingAppender appender(folder, info, random_calibration(random), {});
  for (int i = 0; i < 4 * kPoses; ++i) {
    ProbeSample sample;
    sample.t_ns = 2'500'000 * std::int64_t{i};
    sample.accel_counts = {1.0 * i, -2.0, 3.0};
    appender.add(sample);
  }
  for (int i = 0; i < kPoses; ++i) {
    appender.add(body_pose(i));
    TrackerSample object = body_pose(i);
    object.t_ns += 5'000'000;
    object.body = 1;
    appender.add(object);
  }
  appender.finish(info, only_segments);
}

TEST(TrackedBody, NamesAreLowerCaseAndShort) {
  for (const char* good : {"object", "a", "table-2", "left_hand", "0"}) EXPECT_TRUE(is_body_name(good)) << good;
  for (const char* bad : {"", "Object", "a.b", "../x", "a/b", "ä", "a b", "abcdefghijklmnopqrstuvwxyz0123456"})
    EXPECT_FALSE(is_body_name(bad)) << bad;
  EXPECT_EQ(body_file("object"), "tracker_object.csv");
  EXPECT_TRUE(is_body_file("tracker_object.csv"));
  for (const char* other : {"tracker.csv", "tracker_.csv", "tracker_A.csv", "tracker_a.txt", "x_tracker_a.csv"})
    EXPECT_FALSE(is_body_file(other)) << other;
}

TEST(TrackedBody, WhatIsRecordedReadsBack) {
  const testkit::TempDir dir;
  record_with_object(dir / "rec");
  const Recording recording = read_recording(dir / "rec");
  EXPECT_TRUE(recording.problems.empty());
  ASSERT_EQ(recording.info.bodies.size(), 1u);
  EXPECT_THAT(recording.info.bodies[0].markers, ElementsAre(7, 9));
  const TrackerStream* object = recording.poses_of(kObjectBody);
  ASSERT_NE(object, nullptr);
  EXPECT_EQ(recording.poses_of("another"), nullptr);
  ASSERT_EQ(object->size(), std::size_t{kPoses});
  EXPECT_EQ(object->T_world_marker[77].translation_m, body_pose(77).T_world_marker.translation_m);
  EXPECT_EQ(object->t_ns[77], body_pose(77).t_ns + 5'000'000);
}

TEST(TrackedBody, OnlySegmentsAreKeptOfItToo) {
  const testkit::TempDir dir;
  RecordingInfo info = info_with_object();
  info.segments = {{"kept", 0, 5'000'000'000}};
  record_with_object(dir / "rec", info, true);
  const Recording recording = read_recording(dir / "rec");
  EXPECT_TRUE(recording.problems.empty());
  EXPECT_EQ(recording.body_poses[0].size(), 500u);
  const Recording part = cut_recording(recording, 1'000'000'000, 2'000'000'000);
  EXPECT_EQ(part.body_poses[0].size(), 100u);
}

TEST(TrackedBody, ChangedBytesOfItAreReportedAndLeftOut) {
  const testkit::TempDir dir, saved;
  record_with_object(dir / "rec");
  std::string text = body_text_of(dir / "rec/tracker_object.csv");
  const std::size_t digit = text.find("0.25", text.size() / 2);
  text[digit + 2] = '7';
  write_file(dir / "rec/tracker_object.csv", text);
  const Recording recording = read_recording(dir / "rec");
  ASSERT_EQ(recording.problems.size(), 1u);
  EXPECT_EQ(recording.problems[0].kind, "changed");
  EXPECT_THAT(recording.problems[0].message, HasSubstr("tracker_object.csv"));

  const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path());
  ASSERT_EQ(recovered.bodies.size(), 1u);
  EXPECT_EQ(recovered.bodies[0].changed_rows + 1, recording.problems[0].count);  // lines, the header among them
  EXPECT_EQ(recovered.bodies[0].rows + recovered.bodies[0].changed_rows, std::size_t{kPoses});
  EXPECT_FALSE(recovered.lost_nothing());
  const Recording again = read_recording(saved.path());
  EXPECT_TRUE(again.problems.empty());
  EXPECT_EQ(again.body_poses[0].size(), recovered.bodies[0].rows);
  EXPECT_EQ(again.tracker.size(), std::size_t{kPoses});
  EXPECT_TRUE(again.info.extra["recovered"]["bodies"].contains("object"));
}

TEST(TrackedBody, RecoveredWithoutItsFileTheScanIsOfTheWorldAgain) {
  const testkit::TempDir dir, saved;
  record_with_object(dir / "rec");
  fs::remove(dir / "rec/tracker_object.csv");
  EXPECT_THAT([&] { read_recording(dir / "rec"); }, ThrowsMessage<Error>(HasSubstr("tracker_object.csv")));
  const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path());
  EXPECT_FALSE(recovered.lost_nothing());
  const Recording again = read_recording(saved.path());
  EXPECT_TRUE(again.info.bodies.empty());
  EXPECT_TRUE(again.body_poses.empty());
}

// recording.json of another take does not name the bodies of this one: their files do.
TEST(TrackedBody, RecoveredByAnotherTakesInfoItsStreamIsKept) {
  const testkit::TempDir dir, saved;
  record_with_object(dir / "rec");
  RecordingInfo other;
  other.bodies = {{"table", {3}}};
  record_with_object(dir / "like", other);
  write_file(dir / "rec/recording.json", "{");
  RecoverOptions options;
  options.like = dir / "like";
  const RecoveredRecording recovered = recover_recording(dir / "rec", saved.path(), options);
  ASSERT_EQ(recovered.bodies.size(), 2u);
  EXPECT_EQ(recovered.bodies[0].file, "tracker_table.csv");
  EXPECT_FALSE(recovered.bodies[0].found);
  EXPECT_EQ(recovered.bodies[1].rows, std::size_t{kPoses});
  const Recording again = read_recording(saved.path());
  ASSERT_EQ(again.info.bodies.size(), 1u);
  EXPECT_EQ(again.info.bodies[0].name, "object");
  EXPECT_EQ(again.body_poses[0].size(), std::size_t{kPoses});
}

TEST(TrackedBody, CutAtAnyByteOfTheTailItReads) {
  const testkit::TempDir dir;
  record_with_object(dir / "rec");
  fs::remove(dir / "rec/checksums.txt");
  const std::string whole = body_text_of(dir / "rec/tracker_object.csv");
  for (std::size_t cut = 0; cut < 150; ++cut) {
    write_file(dir / "rec/tracker_object.csv", whole.substr(0, whole.size() - cut));
    const Recording recording = read_recording(dir / "rec");
    const std::string left = whole.substr(0, whole.size() - cut);
    EXPECT_EQ(recording.body_poses[0].size(), static_cast<std::size_t>(std::count(left.begin(), left.end(), '\n')) - 1);
    EXPECT_EQ(recording.problems.empty(), left.back() == '\n');
  }
}

TEST(TrackedBody, ThatWasNeverSeenIsEmpty) {
  const testkit::TempDir dir;
  record_with_object(dir / "rec");
  fs::remove(dir / "rec/checksums.txt");
  const std::string whole = body_text_of(dir / "rec/tracker_object.csv");
  write_file(dir / "rec/tracker_object.csv", whole.substr(0, whole.find('\n') + 1));
  const Recording recording = read_recording(dir / "rec");
  EXPECT_EQ(recording.body_poses[0].size(), 0u);
  ASSERT_EQ(recording.problems.size(), 1u);
  EXPECT_EQ(recording.problems[0].kind, "body_unseen");
  write_file(dir / "rec/tracker_object.csv", "t_ns,px_m\n");
  EXPECT_THROW(read_recording(dir / "rec"), Error);
}

TEST(TrackedBody, ALinkOutOfTheFolderIsNotRead) {
  const testkit::TempDir dir;
  record_with_object(dir / "rec");
  fs::rename(dir / "rec/tracker_object.csv", dir / "elsewhere.csv");
  fs::create_symlink(dir / "elsewhere.csv", dir / "rec/tracker_object.csv");
  EXPECT_THAT([&] { read_recording(dir / "rec"); }, ThrowsMessage<Error>(HasSubstr("link out of the recording")));
}

TEST(TrackedBody, BadListsAreOneErrorThatNamesTheKey) {
  const auto parse = [](const std::string& bodies) {
    parse_recording_info(R"({"format":"asperity-recording","version":1,"bodies":)" + bodies + "}", "recording.json");
  };
  EXPECT_NO_THROW(parse(R"([{"name":"object"}])"));
  EXPECT_NO_THROW(parse(R"([{"name":"object","file":"tracker_object.csv","markers":[1,2]}])"));
  for (
      const auto& [bodies, message] :
      {std::pair{R"([{"name":"Object"}])", "bodies[0].name"},
       {R"([{}])", "name"},
       {R"([{"name":"object","file":"../../etc/passwd"}])", "must be 'tracker_object.csv'"},
       {R"([{"name":"object","file":"tracker.csv"}])", "must be 'tracker_object.csv'"},
       {R"([{"name":"object","markers":[1.5]}])", "markers"},
       {R"([{"name":"object","markers":[-1]}])", "markers"},
       {R"([{"name":"object","colour":1}])", "colour"},
       {R"([{"name":"a"},{"name":"a"}])", "listed twice"},
       {R"([{"name":"a"},{"name":"b"},{"name":"c"},{"name":"d"},{"name":"e"},{"name":"f"},{"name":"g"},{"name":"h"},{"name":"i"}])",
        "bodies"},
       {R"(7)", "bodies"}}) {
    const auto parse_it = [&parse, text = std::string(bodies)] { parse(text); };
    EXPECT_THAT(parse_it, ThrowsMessage<Error>(HasSubstr(message))) << bodies;
  }
}

TEST(TrackedBody, MarkersAreParted) {
  std::vector<MarkerPlacement> markers(5);
  for (int i = 0; i < 5; ++i) markers[static_cast<std::size_t>(i)].id = i;
  markers[1].body = markers[4].body = "object";
  markers[3].body = "table";
  EXPECT_EQ(markers_of_body(markers, "").size(), 2u);
  EXPECT_EQ(markers_of_body(markers, "object")[1].id, 4);
  const std::vector<TrackedBody> bodies = tracked_bodies(markers);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[0].name, "object");
  EXPECT_THAT(bodies[0].markers, ElementsAre(1, 4));
  EXPECT_THAT(bodies_of(markers), ElementsAre("object", "table"));
}

TEST(TrackedBody, ImportedPosesOfAnObject) {
  ImportInput input;
  parse_imu_csv("t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps\n0,0,0,9.81,0,0,0\n0.01,0,0,9.81,0,0,0\n", "i",
                input);
  const std::string poses = "t_s,px_m,py_m,pz_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.01,0.001,0,0,1,0,0,0\n";
  parse_pose_csv(poses, "p", input);
  const Recording without = import_imu_pose(input, {});
  EXPECT_TRUE(without.info.bodies.empty());
  parse_object_pose_csv(poses, "o", input);
  const testkit::TempDir dir;
  ImportConfig config;
  config.pose_noise_m = {1e-3, 1e-3, 1e-3};
  const Recording with = import_imu_pose(input, config);
  write_recording(dir.path(), with);
  EXPECT_TRUE(is_replaceable_recording(dir.path()));
  const Recording read = read_recording(dir.path());
  ASSERT_NE(read.poses_of("object"), nullptr);
  EXPECT_EQ(read.poses_of("object")->size(), 2u);
  // Its noise is of its own: errors that both had in common would cancel.
  EXPECT_NE(read.body_poses[0].T_world_marker[0].translation_m, read.tracker.T_world_marker[0].translation_m);
}

}  // namespace
}  // namespace asperity
