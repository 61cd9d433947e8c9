#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "asperity/recorder/recorder.h"
#include "asperity/recording/read_recording.h"
#include "recorder_rig.h"

namespace asperity {
namespace {

// Each pose of another tracker twice: as the probe's, and as the body's beside it.
class DoubledPoses : public PoseSource {
 public:
  explicit DoubledPoses(std::unique_ptr<PoseSource> source) : source_(std::move(source)) {}
  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    if (again_) return std::exchange(again_, std::nullopt);
    auto pose = source_->read(timeout);
    if (!pose) return pose;
    again_ = pose;
    again_->sample.body = 1;
    again_->sample.T_world_marker.translation_m.y() = 0.1;
    again_->sample.markers = 3;
    return pose;
  }
  TrackingStatistics statistics() const override { return source_->statistics(); }
  double nominal_rate_Hz() const override { return source_->nominal_rate_Hz(); }
  std::string name() const override { return source_->name(); }

 private:
  std::unique_ptr<PoseSource> source_;
  std::optional<TrackedPose> again_;
};

TEST(RecorderBodies, WhatTheCalibrationsMarkersNameIsRecorded) {
  RecorderRig rig;
  rig.config.start_at_once = true;
  Calibration calibration = calibration_of();
  calibration.markers.resize(2);
  calibration.markers[1].id = 9;
  calibration.markers[0].family = calibration.markers[1].family = "tag36h11";
  calibration.markers[0].size_m = calibration.markers[1].size_m = 0.03;
  calibration.markers[1].body = "object";
  const auto open = [inner = open_fake_poses(rig.poses)] { return std::make_unique<DoubledPoses>(inner()); };
  Recorder recorder(rig.folder(), RecordingInfo{}, calibration, RecorderSensors{open_fake_probe(rig.probe), open},
                    rig.config);
  ASSERT_TRUE(wait_for(recorder, [](const RecorderSnapshot& now) {
    return now.recorded_s > 0.5 && now.bodies.size() == 1 && now.bodies[0].pose && now.bodies[0].rows > 20;
  }));
  const RecorderSnapshot live = recorder.snapshot();
  EXPECT_EQ(live.bodies[0].name, "object");
  EXPECT_EQ(live.bodies[0].pose->markers, 3);
  EXPECT_EQ(live.pose->markers, 2);  // the probe's
  const RecorderSnapshot end = recorder.finish();
  // The end may come between a frame's two poses.
  EXPECT_LE(end.bodies[0].rows, end.tracker_rows);
  EXPECT_GE(end.bodies[0].rows + 1, end.tracker_rows);

  const Recording recording = read_recording(rig.folder());
  EXPECT_THAT(recording.problems, testing::IsEmpty());
  ASSERT_EQ(recording.info.bodies.size(), 1u);
  EXPECT_THAT(recording.info.bodies[0].markers, testing::ElementsAre(9));
  EXPECT_EQ(recording.calibration.markers[1].body, "object");
  const TrackerStream* object = recording.poses_of("object");
  ASSERT_NE(object, nullptr);
  ASSERT_EQ(object->t_ns.size(), end.bodies[0].rows);
  EXPECT_TRUE(std::equal(object->t_ns.begin(), object->t_ns.end(), recording.tracker.t_ns.begin()));
  EXPECT_EQ(object->T_world_marker.back().translation_m.y(), 0.1);
  EXPECT_EQ(recording.tracker.T_world_marker.back().translation_m.y(), 0.0);
}

}  // namespace
}  // namespace asperity
