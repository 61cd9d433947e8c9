#include "asperity/acquire/recorder.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/uncalibrated.h"
#include "asperity/testkit/temp_dir.h"
#include "fake_sensors.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// Counts are 0.01 m/s² and 0.01 N; up is −y of the marker, which is level.
Calibration calibration_of() {
  Calibration out;
  out.accelerometer.B = 100.0 * Eigen::Matrix3d::Identity();
  out.force.newton_per_count = 0.01;
  out.tip_in_marker_m = {0.0, 0.1, 0.0};
  return out;
}

// Until `condition` holds of the recorder's snapshot; false after half a minute.
template <class Condition>
bool wait_for(const Recorder& recorder, const Condition& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition(recorder.snapshot())) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

struct Rig {
  testkit::TempDir dir;
  std::shared_ptr<FakeControl> probe = std::make_shared<FakeControl>();
  std::shared_ptr<FakeControl> poses = std::make_shared<FakeControl>();
  RecorderConfig config;

  Rig() {
    config.pre_roll_s = 0.1;
    config.post_roll_s = 0.1;
    config.contact.off_hold_s = 0.05;
    config.stale_s = 0.3;
    config.first_retry_s = 0.02;
  }
  std::filesystem::path folder() const { return dir / "rec"; }
  std::unique_ptr<Recorder> record(const std::optional<Calibration>& calibration = calibration_of()) {
    RecordingInfo info;
    info.object = "cork";
    return std::make_unique<Recorder>(folder(), info, calibration,
                                      RecorderSensors{open_fake_probe(probe), open_fake_poses(poses)}, config);
  }
};

TEST(Recorder, RecordsBothStreamsWithoutLoss) {
  Rig rig;
  rig.config.start_at_once = true;
  const auto recorder = rig.record();
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
  EXPECT_THAT(tracker, HasSubstr(",2,0.125,1e-04,1e-04,1e-04,1e-04,1e-04,1e-04\n"));
}

TEST(Recorder, MeasuresGravityAtRest) {
  Rig rig;
  // The counter in accel_i would be motion.
  Calibration calibration = calibration_of();
  calibration.accelerometer.B(0, 0) = 1e9;
  const auto recorder = rig.record(calibration);
  recorder->start_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.gravity.windows >= 2; }));
  recorder->finish();
  const Recording recording = read_recording(rig.folder());
  EXPECT_LT((recording.info.gravity_world_mps2 - Eigen::Vector3d(0.0, 9.80665, 0.0)).norm(), 1e-3);
  const auto gravity = nlohmann::json::parse(recording.info.extra_json).at("recorder").at("gravity");
  EXPECT_EQ(gravity.at("measured"), true);
  EXPECT_GE(gravity.at("windows_at_rest"), 2);
}

TEST(Recorder, AutoStoresTouchesWithTheRestBefore) {
  Rig rig;
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

TEST(Recorder, DiscardAndRescan) {
  Rig rig;
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

TEST(Recorder, GoesFromHandToTouchAndBack) {
  Rig rig;
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

TEST(Recorder, ASegmentEndsAlsoWhenNothingComesAnyMore) {
  Rig rig;
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

TEST(Recorder, ALostSensorIsReportedAndTakenBack) {
  Rig rig;
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
  Rig rig;
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
  Rig rig;
  rig.poses->silent = true;
  const auto recorder = rig.record();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.running_s > 0.8; }));
  EXPECT_EQ(recorder->snapshot().poses.state, SensorState::kRunning);
  EXPECT_GT(recorder->snapshot().tracking.frames, 0u);
  EXPECT_EQ(recorder->snapshot().tracking.poses, 0u);
}

TEST(Recorder, AFullQueueIsCounted) {
  Rig rig;
  rig.config.probe_queue = 16;
  const auto recorder = rig.record();
  recorder->start_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.probe.overflowed > 0; }));
  const RecorderSnapshot end = recorder->finish();
  EXPECT_EQ(end.probe.highest_queue_fill, 1.0);
  EXPECT_EQ(read_recording(rig.folder()).info.problems.at("probe_queue_overflow"),
            static_cast<std::int64_t>(end.probe.overflowed));
  EXPECT_EQ(end.probe.received, end.probe_rows + end.probe.overflowed);
}

TEST(Recorder, WithoutCalibrationItSaysSo) {
  Rig rig;
  const auto recorder = rig.record(std::nullopt);
  recorder->start_segment();
  ASSERT_TRUE(wait_for(*recorder, [](const RecorderSnapshot& now) { return now.tracker_rows > 5; }));
  EXPECT_FALSE(recorder->snapshot().force_is_calibrated);
  recorder->finish();
  EXPECT_TRUE(is_uncalibrated(read_recording(rig.folder()).calibration));
}

TEST(Recorder, RefusesAnExistingFolderAndAMissingProbe) {
  Rig rig;
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
  Rig rig;
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
    Rig rig;
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

// The figures of one snapshot belong together, whichever thread asks.
TEST(Recorder, SnapshotsAreOfOneMoment) {
  Rig rig;
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
