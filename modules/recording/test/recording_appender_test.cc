#include "asperity/recording/recording_appender.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <fstream>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "random_recording.h"

namespace asperity {
namespace {

ProbeSample probe_sample(int i) {
  ProbeSample out;
  out.t_ns = 250'000 * std::int64_t{i};
  out.accel_counts = {1.0 * i, -2.0 * i, 2048.5};
  if (i % 3 == 0) out.force_counts = 10.0 + i;
  return out;
}

TrackerSample tracker_sample(int i) {
  TrackerSample out;
  out.t_ns = 22'000'000 * std::int64_t{i};
  out.T_world_marker.translation_m = {0.001 * i, 0.1, 1.0 / 3.0};
  return out;
}

Calibration any_calibration() {
  Random random(1);
  return random_calibration(random);
}

void append_tail(const std::filesystem::path& path, const std::string& tail) {
  std::ofstream(path, std::ios::binary | std::ios::app) << tail;
}

TEST(Append, WhatWasDiscardedBeforeACrashIsReported) {
  const testkit::TempDir dir;
  RecordingInfo info;
  info.segments = {{"kept", 0, 50'000'000}};
  info.extra = parse_json(
      R"({"recorder":{"state":"recording","discarded_until_ns":90000000,"discarded":[{"name":"spoilt","start_ns":60000000,"end_ns":90000000},7]}})");
  {
    RecordingAppender appender(dir / "rec", info, any_calibration(), {});
    for (int i = 0; i < 400; ++i) appender.add(probe_sample(i));
    for (int i = 0; i < 5; ++i) appender.add(tracker_sample(i));
  }
  const Recording recording = read_recording(dir / "rec");
  EXPECT_EQ(recording.info.segments.size(), 1u);
  EXPECT_THAT(recording.problems,
              testing::Contains(
                  testing::AllOf(testing::Field(&Problem::kind, "discarded_rows"),
                                 testing::Field(&Problem::message, testing::HasSubstr("in its files: spoilt (")))));
}

TEST(Append, FinishedRecordingIsWhole) {
  const testkit::TempDir dir;
  RecordingInfo info;
  info.object = "cork";
  AppendColumns columns;
  columns.gyro = true;
  columns.markers = true;
  RecordingAppender appender(dir / "rec", info, any_calibration(), columns);
  for (int i = 0; i < 5000; ++i) appender.add(probe_sample(i));
  for (int i = 0; i < 50; ++i) appender.add(tracker_sample(i));
  info.segments = {{"all", 0, 1000}};
  info.problems = {{"lost_packets", 4}};
  appender.finish(info);

  const Recording recording = read_recording(dir / "rec");
  EXPECT_THAT(recording.problems, testing::IsEmpty());
  EXPECT_EQ(recording.info.problems.at("lost_packets"), 4);
  EXPECT_EQ(recording.info.segments.size(), 1u);
  ASSERT_EQ(recording.probe.size(), 5000u);
  ASSERT_EQ(recording.tracker.size(), 50u);
  EXPECT_EQ(recording.probe.accel_counts[4999], probe_sample(4999).accel_counts);
  EXPECT_EQ(recording.probe.force_counts[3], 13.0);
  EXPECT_TRUE(std::isnan(recording.probe.force_counts[4]));
  EXPECT_EQ(recording.tracker.T_world_marker[49].translation_m, tracker_sample(49).T_world_marker.translation_m);
  EXPECT_THROW(appender.flush(), Error);
}

TEST(Append, NeverOverwrites) {
  const testkit::TempDir dir;
  { RecordingAppender appender(dir / "rec", {}, any_calibration()); }
  EXPECT_THAT([&] { RecordingAppender(dir / "rec", {}, any_calibration()); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("not empty")));
}

TEST(Append, CutAtEveryByteOfTheTail) {
  const testkit::TempDir dir;
  {
    RecordingAppender appender(dir / "rec", {}, any_calibration());
    for (int i = 0; i < 20; ++i) appender.add(probe_sample(i));
    for (int i = 0; i < 20; ++i) appender.add(tracker_sample(i));
  }
  for (const char* name : {"probe.csv", "tracker.csv"}) {
    const auto path = dir / "rec" / name;
    const std::string whole = read_file(path, 1 << 20);
    const auto rows_in = [](const std::string& text) {
      return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) - 1;
    };
    for (std::size_t size = whole.size(); rows_in(whole.substr(0, size)) > 15; --size) {
      std::filesystem::resize_file(path, size);
      const Recording recording = read_recording(dir / "rec");
      const std::size_t rows = std::string(name) == "probe.csv" ? recording.probe.size() : recording.tracker.size();
      ASSERT_EQ(rows, rows_in(whole.substr(0, size))) << name << " cut at " << size;
      ASSERT_EQ(recording.problems.empty(), whole[size - 1] == '\n') << name << " cut at " << size;
    }
    std::filesystem::resize_file(path, 0);
    append_tail(path, whole);
  }
}

TEST(Append, KilledProcessLeavesAReadableRecording) {
  const testkit::TempDir dir;
  const Calibration calibration = any_calibration();
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    try {
      RecordingAppender appender(dir / "rec", {}, calibration);
      for (int i = 0;; ++i) {
        appender.add(probe_sample(i));
        if (i % 50 == 0) appender.add(tracker_sample(i / 50));
        if (i == 1000) appender.flush();
        if (i == 3000 && ::write(ready[1], "x", 1) != 1) ::_exit(1);
      }
    } catch (...) {
      ::_exit(1);
    }
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  ::close(ready[0]);
  ::close(ready[1]);

  const Recording recording = read_recording(dir / "rec");
  EXPECT_GE(recording.probe.size(), 1001u);
  EXPECT_GE(recording.tracker.size(), 21u);
  for (std::size_t i = 0; i < recording.probe.size(); ++i) {
    ASSERT_EQ(recording.probe.t_ns[i], probe_sample(static_cast<int>(i)).t_ns);
    ASSERT_EQ(recording.probe.accel_counts[i], probe_sample(static_cast<int>(i)).accel_counts);
  }
  for (const auto& problem : recording.problems) EXPECT_EQ(problem.kind, "truncated");
}

}  // namespace
}  // namespace asperity
