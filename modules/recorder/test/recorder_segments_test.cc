#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "asperity/recorder/recorder.h"
#include "asperity/recording/read_recording.h"
#include "recorder_rig.h"

namespace asperity {
namespace {

TEST(RecorderSegments, AutoStoresTouchesWithTheRestBefore) {
  RecorderRig rig;
  rig.config.mode = StoreMode::kAuto;
  const auto recorder = rig.record();
  for (std::uint64_t touch = 1; touch <= 2; ++touch) {
    const double start_s = recorder->snapshot().running_s;
    ASSERT_TRUE(wait_for(*recorder, [&](const RecorderSnapshot& now) { return now.running_s > start_s + 0.3; }));
    rig.probe->force_counts = 100.0;
    ASSERT_TRUE(wait_for(*recorder, [&](const RecorderSnapshot& now) { return now.touches == touch; }));
    EXPECT_TRUE(recorder->snapshot().touching);
    rig.probe->force_counts = 0.0;
    ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return !now.storing; }));
  }
  recorder->finish();
  const Recording recording = read_recording(rig.folder());
  ASSERT_EQ(recording.info.segments.size(), 2u);
  EXPECT_EQ(recording.info.segments[1].name, "contact_2");
  EXPECT_GT(recording.info.segments[1].start_ns, recording.info.segments[0].end_ns);
  for (const Segment& segment : recording.info.segments) {
    std::vector<double> force;
    for (std::size_t i = 0; i < recording.probe.size(); ++i) {
      const std::int64_t t_ns = recording.probe.t_ns[i];
      if (t_ns >= segment.start_ns && t_ns <= segment.end_ns) force.push_back(recording.probe.force_counts[i]);
    }
    ASSERT_GT(force.size(), 800u);
    // 0.1 s of rest before the touch and after it, at 4 kHz.
    const auto touch = std::find(force.begin(), force.end(), 100.0) - force.begin();
    EXPECT_NEAR(static_cast<double>(touch), 400.0, 1.0);
    const auto after = std::find(force.rbegin(), force.rend(), 100.0) - force.rbegin();
    EXPECT_NEAR(static_cast<double>(after), 400.0, 1.0);
  }
}

TEST(RecorderSegments, DiscardAndRescan) {
  RecorderRig rig;
  const auto recorder = rig.record();
  const auto record_a_while = [&] {
    const double start_s = recorder->snapshot().recorded_s;
    EXPECT_TRUE(wait_for(*recorder, [&](const RecorderSnapshot& now) { return now.recorded_s > start_s + 0.1; }));
  };
  recorder->start_segment("left");
  record_a_while();
  recorder->stop_segment();
  recorder->start_segment("right");
  record_a_while();
  recorder->rescan_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.discarded == 1; }));
  record_a_while();
  recorder->stop_segment();
  recorder->start_segment();
  record_a_while();
  recorder->discard_segment();
  const RecorderSnapshot end = recorder->finish();
  EXPECT_EQ(end.discarded, 2u);

  const Recording recording = read_recording(rig.folder());
  ASSERT_EQ(recording.info.segments.size(), 2u);
  EXPECT_EQ(recording.info.segments[0].name, "left");
  EXPECT_EQ(recording.info.segments[1].name, "right");
  EXPECT_LT(recording.probe.size(), end.probe_rows);
  for (const std::int64_t t_ns : recording.probe.t_ns) {
    EXPECT_TRUE(std::any_of(recording.info.segments.begin(), recording.info.segments.end(),
                            [&](const Segment& s) { return t_ns >= s.start_ns && t_ns <= s.end_ns; }));
  }
}

TEST(RecorderSegments, GoesFromHandToTouchAndBack) {
  RecorderRig rig;
  const auto recorder = rig.record();
  rig.probe->force_counts = 100.0;
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.touching; }));
  EXPECT_FALSE(recorder->snapshot().storing);
  recorder->set_mode(StoreMode::kAuto);  // it touches already
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.automatic && now.storing; }));
  ASSERT_EQ(recorder->snapshot().segment_list.size(), 1u);
  EXPECT_EQ(recorder->snapshot().segment_list[0].name, "contact_1");
  recorder->set_mode(StoreMode::kSegments);
  rig.probe->force_counts = 0.0;
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return !now.automatic && !now.touching; }));
  EXPECT_TRUE(recorder->snapshot().storing);  // until it is stopped
  recorder->stop_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return !now.storing; }));
}

TEST(RecorderSegments, ASegmentEndsAlsoWhenNothingComesAnyMore) {
  RecorderRig rig;
  const auto recorder = rig.record();
  recorder->start_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.probe_rows > 100; }));
  rig.probe->unplugged = true;
  rig.poses->unplugged = true;
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) {
    return now.probe.state == SensorState::kLost && now.poses.state == SensorState::kLost;
  }));
  recorder->stop_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return !now.storing; }));
  EXPECT_EQ(recorder->snapshot().segments, 1u);
}

}  // namespace
}  // namespace asperity
