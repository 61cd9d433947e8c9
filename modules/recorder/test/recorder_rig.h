#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "asperity/recorder/recorder.h"
#include "asperity/testkit/temp_dir.h"
#include "fake_sensors.h"

namespace asperity {

// Counts are 0.01 m/s² and 0.01 N; up is −y of the marker, which is level.
inline Calibration calibration_of() {
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

// A recorder of two sensors that do as they are told, in a folder of its own.
struct RecorderRig {
  testkit::TempDir dir;
  std::shared_ptr<FakeControl> probe = std::make_shared<FakeControl>();
  std::shared_ptr<FakeControl> poses = std::make_shared<FakeControl>();
  RecorderConfig config;

  RecorderRig() {
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

}  // namespace asperity
