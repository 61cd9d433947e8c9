#include "asperity/recorder/segment_writer.h"

#include <gmock/gmock.h>

#include "asperity/recording/read_recording.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

constexpr std::int64_t kMs = 1'000'000;

ProbeSample probe_at(std::int64_t t_ms) {
  ProbeSample out;
  out.t_ns = t_ms * kMs;
  out.accel_counts.x() = static_cast<double>(t_ms);
  return out;
}

TrackerSample pose_at(std::int64_t t_ms) {
  TrackerSample out;
  out.t_ns = t_ms * kMs;
  return out;
}

Calibration unit_calibration() {
  Calibration out;
  out.accelerometer.B = Eigen::Matrix3d::Identity();
  out.tip_in_marker_m = {0.0, 0.0, 0.1};
  return out;
}

std::vector<std::int64_t> in_ms(const std::vector<std::int64_t>& t_ns) {
  std::vector<std::int64_t> out;
  for (const std::int64_t t : t_ns) out.push_back(t / kMs);
  return out;
}

std::vector<std::int64_t> range(std::int64_t first, std::int64_t last, std::int64_t step) {
  std::vector<std::int64_t> out;
  for (std::int64_t t = first; t <= last; t += step) out.push_back(t);
  return out;
}

struct Rig {
  testkit::TempDir dir;
  RecordingInfo info;
  RecordingAppender appender{dir / "rec", info, unit_calibration()};
  SegmentWriter writer{appender, 1000 * kMs};
  std::int64_t now_ms = 1;

  // Probe rows each 10 ms; poses each 20 ms, which come 50 ms late.
  void run_to(std::int64_t end_ms) {
    for (; now_ms < end_ms; ++now_ms) {
      if (now_ms % 10 == 0) writer.add(probe_at(now_ms));
      if (now_ms % 20 == 10 && now_ms > 50) writer.add(pose_at(now_ms - 50));
      writer.settle();
    }
  }

  Recording finish(bool only_segments = false) {
    writer.close(writer.latest_ns());
    info.segments = writer.segments();
    appender.finish(info, only_segments);
    return read_recording(dir / "rec");
  }
};

TEST(SegmentWriter, StoresSegmentsWithTheirPreRollAndLatePoses) {
  Rig rig;
  rig.run_to(3000);
  ASSERT_TRUE(rig.writer.start("a", 2995 * kMs, 500 * kMs));
  EXPECT_FALSE(rig.writer.start("b", 2996 * kMs, 0));
  rig.run_to(3500);
  rig.writer.end_at(3600 * kMs);
  EXPECT_TRUE(rig.writer.is_ending());
  rig.run_to(3700);
  EXPECT_FALSE(rig.writer.is_open());
  rig.run_to(5000);
  const Recording recording = rig.finish();
  EXPECT_EQ(in_ms(recording.probe.t_ns), range(2500, 3600, 10));
  EXPECT_EQ(in_ms(recording.tracker.t_ns), range(2500, 3600, 20));
  ASSERT_EQ(recording.info.segments.size(), 1u);
  EXPECT_EQ(recording.info.segments[0].name, "a");
  EXPECT_EQ(recording.info.segments[0].start_ns, 2495 * kMs);
  EXPECT_EQ(recording.info.segments[0].end_ns, 3600 * kMs);
  EXPECT_NEAR(rig.writer.recorded_s(), 1.105, 1e-9);
}

TEST(SegmentWriter, ThePreRollReachesIntoTheSegmentBeforeWithoutWritingTwice) {
  Rig rig;
  rig.run_to(1000);
  rig.writer.start("a", 1000 * kMs, 100 * kMs);
  rig.run_to(2000);
  rig.writer.end_at(2000 * kMs);
  rig.run_to(2300);
  rig.writer.start("b", 2300 * kMs, 500 * kMs);
  rig.run_to(2600);
  const Recording recording = rig.finish();
  EXPECT_EQ(in_ms(recording.probe.t_ns), range(900, 2590, 10));
  EXPECT_EQ(recording.info.segments[1].start_ns, 1800 * kMs);
  EXPECT_THAT(recording.problems, testing::IsEmpty());
}

TEST(SegmentWriter, AFurtherBodysPosesAreStoredAsTheProbes) {
  testkit::TempDir dir;
  RecordingInfo info;
  info.bodies = {{"object", {}}};
  RecordingAppender appender(dir / "rec", info, unit_calibration());
  SegmentWriter writer(appender, 1000 * kMs);
  for (std::int64_t t_ms = 10; t_ms <= 3000; t_ms += 10) {
    writer.add(probe_at(t_ms));
    TrackerSample pose = pose_at(t_ms);
    writer.add(pose);
    pose.t_ns += 3 * kMs;
    pose.body = 1;
    writer.add(pose);
    if (t_ms == 1000) writer.start("a", 1000 * kMs, 500 * kMs);
    if (t_ms == 2000) writer.end_at(2000 * kMs);
    writer.settle();
  }
  EXPECT_EQ(writer.late_rows(), 0u);
  EXPECT_EQ(writer.body_rows(1), 151u);  // that of 2003 ms came while the segment was open, before its end was known
  EXPECT_EQ(writer.body_rows(2), 0u);
  info.segments = writer.segments();
  appender.finish(info, true);
  const Recording recording = read_recording(dir / "rec");
  EXPECT_EQ(in_ms(recording.tracker.t_ns), range(500, 2000, 10));
  EXPECT_EQ(in_ms(recording.body_poses[0].t_ns), range(503, 1993, 10)) << "a row of no segment is left";
}

TEST(SegmentWriter, ReopeningGoesOn) {
  Rig rig;
  rig.run_to(1000);
  rig.writer.start("a", 1000 * kMs, 0);
  rig.run_to(1100);
  rig.writer.end_at(1500 * kMs);
  rig.run_to(1400);
  EXPECT_TRUE(rig.writer.reopen());
  rig.run_to(2000);
  EXPECT_FALSE(rig.writer.reopen());
  const Recording recording = rig.finish();
  EXPECT_EQ(in_ms(recording.probe.t_ns), range(1000, 1990, 10));
  EXPECT_EQ(recording.info.segments.size(), 1u);
}

TEST(SegmentWriter, DiscardedRowsAreTakenOutAtTheEnd) {
  Rig rig;
  rig.run_to(1000);
  EXPECT_EQ(rig.writer.discard(1000 * kMs), std::nullopt);
  rig.writer.start("a", 1000 * kMs, 0);
  rig.run_to(2000);
  rig.writer.end_at(2000 * kMs);
  rig.run_to(3000);
  rig.writer.start("b", 3000 * kMs, 0);
  rig.run_to(4000);
  EXPECT_EQ(rig.writer.discard(4000 * kMs), "b");  // the open one
  EXPECT_FALSE(rig.writer.is_open());
  rig.run_to(4100);
  rig.writer.start("b", 4100 * kMs, 500 * kMs);  // the pre-roll does not reach into what was discarded
  rig.run_to(5000);
  rig.writer.end_at(5000 * kMs);
  rig.run_to(5100);
  rig.writer.start("c", 5100 * kMs, 0);
  rig.run_to(5200);
  rig.writer.end_at(5200 * kMs);
  rig.run_to(6000);
  EXPECT_EQ(rig.writer.discard(6000 * kMs), "c");  // the last one
  EXPECT_EQ(rig.writer.discarded(), 2u);
  const Recording recording = rig.finish(true);
  std::vector<std::int64_t> kept = range(1000, 2000, 10);
  for (const std::int64_t t : range(4000, 5000, 10)) kept.push_back(t);
  EXPECT_EQ(in_ms(recording.probe.t_ns), kept);
  EXPECT_EQ(recording.tracker.size(), 102u);
  ASSERT_EQ(recording.info.segments.size(), 2u);
  EXPECT_EQ(recording.info.segments[1].start_ns, 4000 * kMs);
}

TEST(SegmentWriter, BringsBackWhatWasDiscardedWithItsLateRows) {
  Rig rig;
  rig.run_to(1000);
  EXPECT_EQ(rig.writer.restore(), std::nullopt);
  rig.writer.start("a", 1000 * kMs, 0);
  rig.run_to(2000);
  EXPECT_EQ(rig.writer.discard(2000 * kMs), "a");  // its last poses have not come yet
  rig.run_to(3000);
  ASSERT_EQ(rig.writer.discarded_rows().size(), 1u);
  rig.writer.start("a", 3000 * kMs, 0);
  rig.run_to(3500);
  EXPECT_EQ(rig.writer.restore(), "a_restored");  // the name was given again
  EXPECT_TRUE(rig.writer.is_open());              // the second goes on
  EXPECT_EQ(rig.writer.last_name(), "a");
  EXPECT_EQ(rig.writer.discarded(), 0u);
  EXPECT_EQ(rig.writer.discarded_until_ns(), std::nullopt);
  EXPECT_EQ(rig.writer.restore(), std::nullopt);
  rig.run_to(4000);
  const Recording recording = rig.finish(true);
  std::vector<std::int64_t> kept = range(1000, 2000, 10);
  for (const std::int64_t t : range(3000, 3990, 10)) kept.push_back(t);
  EXPECT_EQ(in_ms(recording.probe.t_ns), kept);
  // Poses at 10, 30, … ms; the last ones of the run come after its end.
  std::vector<std::int64_t> poses = range(1000, 2000, 20);
  for (const std::int64_t t : range(3000, 3940, 20)) poses.push_back(t);
  EXPECT_EQ(in_ms(recording.tracker.t_ns), poses);
  ASSERT_EQ(recording.info.segments.size(), 2u);
  EXPECT_EQ(recording.info.segments[0].name, "a_restored");
  EXPECT_EQ(recording.info.segments[0].end_ns, 2000 * kMs);
}

TEST(SegmentWriter, WhatWasDiscardedBeginsWithItsFirstRow) {
  Rig rig;
  rig.writer.start("a", SegmentWriter::kFromFirstRow, 0);
  rig.run_to(1000);
  rig.writer.discard(1000 * kMs);
  EXPECT_EQ(rig.writer.discarded_rows().back().start_ns, 10 * kMs);
  rig.writer.restore();
  EXPECT_EQ(rig.writer.segments().back().start_ns, 10 * kMs);
}

TEST(SegmentWriter, BringsBackTheLastFirst) {
  Rig rig;
  for (std::int64_t i = 0; i < 3; ++i) {
    rig.run_to(1000 * (i + 1));
    rig.writer.start(std::string(1, static_cast<char>('a' + i)), 1000 * (i + 1) * kMs, 0);
    rig.run_to(1000 * (i + 1) + 500);
    rig.writer.close((1000 * (i + 1) + 500) * kMs);
  }
  for (int i = 0; i < 3; ++i) rig.writer.discard(rig.writer.latest_ns());
  EXPECT_EQ(rig.writer.count(), 0u);
  EXPECT_EQ(rig.writer.restore(), "a");  // was discarded last
  EXPECT_EQ(rig.writer.restore(), "b");
  EXPECT_EQ(rig.writer.restored(), 2u);
  const Recording recording = rig.finish(true);
  ASSERT_EQ(recording.info.segments.size(), 2u);
  EXPECT_EQ(recording.probe.t_ns.back() / kMs, 2500);
}

TEST(SegmentWriter, GivesTheOldestUpAtLast) {
  Rig rig;
  rig.run_to(100);
  for (std::size_t i = 0; i < SegmentWriter::kMostDiscarded + 2; ++i) {
    rig.writer.start("s" + std::to_string(i), rig.now_ms * kMs, 0);
    rig.run_to(rig.now_ms + 20);
    rig.writer.discard(rig.now_ms * kMs);
  }
  EXPECT_EQ(rig.writer.discarded_rows().size(), SegmentWriter::kMostDiscarded);
  EXPECT_EQ(rig.writer.discarded_rows().front().name, "s2");
  EXPECT_EQ(rig.writer.discarded(), SegmentWriter::kMostDiscarded + 2);
}

TEST(SegmentWriter, DropsRowsThatGoBackInTime) {
  Rig rig;
  rig.writer.start("a", 0, 0);
  rig.run_to(100);
  rig.writer.add(probe_at(50));
  rig.writer.add(probe_at(90));
  rig.run_to(200);
  EXPECT_EQ(rig.writer.late_rows(), 2u);
  EXPECT_EQ(in_ms(rig.finish().probe.t_ns), range(10, 190, 10));
}

}  // namespace
}  // namespace asperity
