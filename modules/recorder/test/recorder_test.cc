#include "asperity/recorder/recorder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/recording/read_recording.h"
#include "recorder_rig.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(Recorder, RecordsBothStreamsWithoutLoss) {
  RecorderRig rig;
  rig.config.start_at_once = true;
  // The counter in accel_i would be motion, or, in a window that a busy machine has cut short, a strange gravity.
  Calibration calibration = calibration_of();
  calibration.accelerometer.B(0, 0) = 1e9;
  const auto recorder = rig.record(calibration);
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.recorded_s > 1.2; }));
  const RecorderSnapshot live = recorder->snapshot();
  EXPECT_TRUE(live.storing);
  EXPECT_EQ(live.segment, "segment_1");
  EXPECT_GT(live.probe.rate_Hz, 1000.0);
  EXPECT_EQ(live.pose->markers, 2);
  const RecorderSnapshot end = recorder->finish();
  EXPECT_FALSE(end.storing);
  EXPECT_EQ(end.probe.overflowed, 0u);

  const Recording recording = read_recording(rig.folder());
  EXPECT_THAT(recording.problems, IsEmpty());
  EXPECT_THAT(recording.info.problems, IsEmpty());
  EXPECT_EQ(recording.info.object, "cork");
  EXPECT_EQ(recording.info.probe_rate_Hz, 4000.0);
  EXPECT_NEAR(recording.info.tracker_rate_Hz, 120.0, 1e-3);
  EXPECT_TRUE(recording.probe.has_gyro());
  ASSERT_EQ(recording.info.segments.size(), 1u);
  EXPECT_EQ(recording.probe.size(), end.probe_rows);
  EXPECT_EQ(recording.tracker.size(), end.tracker_rows);
  for (std::size_t i = 1; i < recording.probe.size(); ++i) {
    ASSERT_EQ(recording.probe.accel_counts[i].x(), recording.probe.accel_counts[i - 1].x() + 1.0);
  }
  for (std::size_t i = 1; i < recording.tracker.size(); ++i) {
    ASSERT_NEAR(recording.tracker.T_world_marker[i].translation_m.x(),
                recording.tracker.T_world_marker[i - 1].translation_m.x() + 1e-6, 1e-12);
  }
  EXPECT_EQ(recording.probe.accel_counts.front().x(), 0.0);
  const std::string tracker = read_file(rig.folder() / "tracker.csv", 1 << 24);
  EXPECT_THAT(tracker, HasSubstr("markers,reprojection_px,sigma_px_m,sigma_py_m,sigma_pz_m,sigma_rx_rad"));
  EXPECT_THAT(tracker, HasSubstr(",2,0.125,1e-04,1e-04,1e-04,1e-04,1e-04,1e-04,,,,,,\n"));
}

TEST(Recorder, MeasuresGravityAtRest) {
  RecorderRig rig;
  // The counter in accel_i would be motion.
  Calibration calibration = calibration_of();
  calibration.accelerometer.B(0, 0) = 1e9;
  const auto recorder = rig.record(calibration);
  recorder->start_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.gravity.windows >= 2; }));
  recorder->finish();
  const Recording recording = read_recording(rig.folder());
  EXPECT_LT((recording.info.gravity_world_mps2 - Eigen::Vector3d(0.0, 9.80665, 0.0)).norm(), 1e-3);
  ASSERT_TRUE(recording.info.recorder && recording.info.recorder->gravity);
  EXPECT_TRUE(recording.info.recorder->gravity->measured);
  EXPECT_GE(recording.info.recorder->gravity->windows_at_rest, 2);
}

TEST(Recorder, ALostSensorIsReportedAndTakenBack) {
  RecorderRig rig;
  const auto recorder = rig.record();
  recorder->start_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.tracker_rows > 5; }));
  rig.poses->unplugged = true;
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.poses.state == SensorState::kLost; }));
  EXPECT_THAT(recorder->snapshot().poses.message, HasSubstr("fake: "));
  const std::uint64_t rows = recorder->snapshot().probe_rows;
  ASSERT_TRUE(wait_for(*recorder, [&](const RecorderSnapshot& now) { return now.probe_rows > rows + 1000; }));
  rig.poses->unplugged = false;
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.poses.returned == 1; }));
  EXPECT_EQ(recorder->snapshot().poses.state, SensorState::kRunning);

  // A probe that is there and says nothing.
  rig.probe->silent = true;
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.probe.state == SensorState::kLost; }));
  EXPECT_THAT(recorder->snapshot().probe.message, HasSubstr("nothing comes"));
  rig.probe->silent = false;
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.probe.returned == 1; }));
  recorder->finish();
  const Recording recording = read_recording(rig.folder());
  EXPECT_EQ(recording.info.problems.at("tracker_disappeared"), 1);
  EXPECT_EQ(recording.info.problems.at("probe_disappeared"), 1);
  EXPECT_GE(rig.probe->opened, 2);
}

// The writer of a pipe would die if its reader went.
TEST(Recorder, ASilentStreamStaysOpen) {
  RecorderRig rig;
  RecorderSensors sensors{open_fake_probe(rig.probe), open_fake_poses(rig.poses)};
  sensors.reopen_silent_probe = false;
  Recorder recorder(rig.folder(), {}, calibration_of(), sensors, rig.config);
  rig.probe->silent = true;
  ASSERT_TRUE(wait_for(recorder, [](const RecorderSnapshot& now) { return now.probe.state == SensorState::kLost; }));
  EXPECT_EQ(recorder.snapshot().probe.message, "nothing comes");
  rig.probe->silent = false;
  ASSERT_TRUE(wait_for(recorder, [](const RecorderSnapshot& now) { return now.probe.returned == 1; }));
  EXPECT_EQ(recorder.snapshot().probe.lost, 1u);
  EXPECT_EQ(rig.probe->opened, 1);
}

TEST(Recorder, ATrackerThatSeesNothingIsNotLost) {
  RecorderRig rig;
  rig.poses->silent = true;
  const auto recorder = rig.record();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.running_s > 0.8; }));
  EXPECT_EQ(recorder->snapshot().poses.state, SensorState::kRunning);
  EXPECT_GT(recorder->snapshot().tracking.frames, 0u);
  EXPECT_EQ(recorder->snapshot().tracking.poses, 0u);
}

TEST(Recorder, AFullQueueIsCounted) {
  RecorderRig rig;
  rig.config.probe_queue = 16;
  rig.config.start_at_once = true;  // asked for later, what came much before would not be stored
  const auto recorder = rig.record();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.probe.overflowed > 0; }));
  const RecorderSnapshot end = recorder->finish();
  EXPECT_EQ(end.probe.highest_queue_fill, 1.0);
  EXPECT_EQ(read_recording(rig.folder()).info.problems.at("probe_queue_overflow"),
            static_cast<std::int64_t>(end.probe.overflowed));
  EXPECT_EQ(end.probe.received, end.probe_rows + end.probe.overflowed);
}

TEST(Recorder, WithoutCalibrationItSaysSo) {
  RecorderRig rig;
  const auto recorder = rig.record(std::nullopt);
  recorder->start_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.tracker_rows > 5; }));
  EXPECT_FALSE(recorder->snapshot().force_is_calibrated);
  recorder->finish();
  EXPECT_TRUE(read_recording(rig.folder()).calibration.uncalibrated);
}

TEST(Recorder, RefusesAnExistingFolderAndAMissingProbe) {
  RecorderRig rig;
  std::filesystem::create_directory(rig.folder());
  std::filesystem::create_directory(rig.folder() / "measured");
  EXPECT_THAT([&] { rig.record(); }, testing::ThrowsMessage<Error>(HasSubstr("not empty")));
  EXPECT_EQ(rig.probe->opened, 0);
  std::filesystem::remove(rig.folder() / "measured");
  rig.probe->unplugged = true;
  EXPECT_THAT([&] { rig.record(); }, testing::ThrowsMessage<Error>(HasSubstr("not there")));
  EXPECT_TRUE(std::filesystem::is_empty(rig.folder()));
}

// A capture comes faster than the disk, with times of another day; nothing of it is lost.
TEST(Recorder, ACaptureIsRecordedWhole) {
  RecorderRig rig;
  rig.config.start_at_once = true;
  rig.config.probe_queue = 4096;
  RecorderSensors sensors;
  sensors.open_probe = [] { return std::make_unique<ReplayedProbe>(5'000'000, 250'000, 200'000); };
  sensors.probe_describes_itself = false;
  sensors.reopen_probe = false;
  sensors.replayed = true;
  Recorder recorder(rig.folder(), {}, calibration_of(), sensors, rig.config);
  ASSERT_TRUE(wait_for(recorder, [](const RecorderSnapshot& now) { return now.probe.state == SensorState::kEnded; }));
  recorder.finish();
  const std::string probe = read_file(rig.folder() / "probe.csv", 1 << 24);
  EXPECT_EQ(std::count(probe.begin(), probe.end(), '\n'), 200'001);
  EXPECT_THAT(probe, HasSubstr("\n5000000,"));
}

// A capture of which no more can be read, though it is not at its end.
class BrokenReplay : public ReplayedProbe {
 public:
  using ReplayedProbe::ReplayedProbe;
  void read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout) override {
    if (statistics().samples >= 3000) throw Error("replay: damaged");
    ReplayedProbe::read(out, timeout);
  }
};

TEST(Recorder, AFaultIsToldFromTheEnd) {
  for (const bool broken : {false, true}) {
    RecorderRig rig;
    rig.config.start_at_once = true;
    RecorderSensors sensors;
    sensors.open_probe = [broken]() -> std::unique_ptr<ProbeSource> {
      if (broken) return std::make_unique<BrokenReplay>(5'000'000, 250'000, 6000);
      return std::make_unique<ReplayedProbe>(5'000'000, 250'000, 6000);
    };
    sensors.probe_describes_itself = false;
    sensors.reopen_probe = false;
    sensors.replayed = true;
    Recorder recorder(rig.folder(), {}, calibration_of(), sensors, rig.config);
    ASSERT_TRUE(wait_for(recorder, [](const RecorderSnapshot& now) { return now.probe.state == SensorState::kEnded; }));
    const RecorderSnapshot end = recorder.finish();
    EXPECT_EQ(end.probe.failed, broken);
    EXPECT_EQ(end.probe_rows, broken ? 3000u : 6000u);
  }
}

// What cannot be written besides the recording ends the take, and the recording is final with all its rows.
TEST(Recorder, AFailureBesidesEndsTheTakeAndTheRecordingIsWhole) {
  RecorderRig rig;
  rig.config.start_at_once = true;
  std::atomic<bool> fails{false};
  RecorderSensors sensors;
  sensors.open_probe = [] { return std::make_unique<ReplayedProbe>(5'000'000, 250'000, 6000); };
  sensors.probe_describes_itself = false;
  sensors.reopen_probe = false;
  sensors.replayed = true;
  sensors.failure_besides = [&fails] { return std::string(fails ? "capture.bin: disk full" : ""); };
  Recorder recorder(rig.folder(), {}, calibration_of(), sensors, rig.config);
  ASSERT_TRUE(wait_for(recorder, [](const RecorderSnapshot& now) { return now.probe_rows > 0; }));
  EXPECT_EQ(recorder.snapshot().failure, "");
  fails = true;
  ASSERT_TRUE(wait_for(recorder, [](const RecorderSnapshot& now) { return !now.failure.empty(); }));
  EXPECT_EQ(recorder.snapshot().failure, "capture.bin: disk full");
  EXPECT_THROW(recorder.finish(), Error);
  const std::string info = read_file(rig.folder() / "recording.json", 100'000);
  EXPECT_NE(info.find("\"finished\""), std::string::npos) << info;
  const std::string rows = read_file(rig.folder() / "probe.csv", 10'000'000);
  EXPECT_EQ(static_cast<std::uint64_t>(std::count(rows.begin(), rows.end(), '\n') - 1), recorder.snapshot().probe_rows);
}

// The figures of one snapshot belong together, whichever thread asks.
TEST(Recorder, SnapshotsAreOfOneMoment) {
  RecorderRig rig;
  const auto recorder = rig.record();
  recorder->start_segment();
  std::atomic<bool> done{false};
  std::atomic<int> torn{0};
  std::thread reader([&] {
    std::uint64_t before = 0;
    while (!done) {
      const RecorderSnapshot now = recorder->snapshot();
      const bool stored_is_received = now.probe_rows <= now.probe.received && now.tracker_rows <= now.tracking.poses;
      if (!stored_is_received || now.probe_rows < before) ++torn;
      before = now.probe_rows;
      std::this_thread::yield();
    }
  });
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.recorded_s > 0.5; }));
  done = true;
  reader.join();
  EXPECT_EQ(torn, 0);
}

}  // namespace
}  // namespace asperity
