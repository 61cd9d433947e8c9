#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "asperity/link/probe_source.h"
#include "asperity/recorder/recorder_config.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "asperity/recording/recording.h"
#include "asperity/tracking/pose_source.h"

namespace asperity {

// How the recorder comes to its sensors, and comes to them again when they were gone. Each function throws Error
// if it cannot.
struct RecorderSensors {
  std::function<std::unique_ptr<ProbeSource>()> open_probe;
  std::function<std::unique_ptr<PoseSource>()> open_poses;  // empty: no tracker
  bool probe_describes_itself = true;                       // false: the columns are known without
  bool reopen_probe = true;                                 // false: a file, whose end is the end, and which can wait
  bool reopen_poses = true;
  // False: a pipe or a socket, which goes on after a silence, and whose other end might not begin anew if it was
  // closed.
  bool reopen_silent_probe = true;
  bool reopen_silent_poses = true;
  bool replayed = false;  // times are not of now: commands happen at the newest row's
  // Why something that is written besides the recording, such as a capture, cannot be; empty: nothing is wrong. The
  // first reason ends the take, and the recording is whole. Any thread; may be none.
  std::function<std::string()> failure_besides = nullptr;
};

// Records a probe and a tracker (thesis §3.3, docs/recorder.md): a thread for each sensor, which never waits for the
// disk, and one that writes. Thread-safe but for finish().
class Recorder {
 public:
  // Opens the sensors, waits until the probe has described itself, makes `folder` and begins to read. `info` gives
  // what no sensor knows (created, object, world, the gravity assumed until it is measured, extra); the rest is
  // filled in. Without info.bodies, those of the calibration's markers are recorded besides the probe's. Without a
  // calibration the probe's nominal scales stand in for one, and say so. Throws Error if a sensor
  // cannot be opened, a setting is wrong, or the folder exists and is not empty.
  Recorder(const std::filesystem::path& folder, const RecordingInfo& info,
           const std::optional<Calibration>& calibration, RecorderSensors sensors, const RecorderConfig& config = {});
  // Finishes if finish() was not called; what goes wrong then is lost.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Asked for here, done by the writing thread within `flush_s`, with the times at which they were asked for.
  // In the mode `auto` segments start and stop by themselves: the first two do nothing.
  void start_segment(std::string name = "");  // "": segment_1, segment_2, …
  void stop_segment();
  void discard_segment();  // the open one, or else the last
  void rescan_segment();   // discards, and starts one with the same name
  void restore_segment();  // brings back what was discarded last
  // From now on. An open segment goes on: by hand it is then to be stopped, in `auto` it ends with the touch.
  void set_mode(StoreMode mode);

  RecorderSnapshot snapshot() const;

  // Stops the sensors, writes what waits, and makes the recording final. The snapshot at the end. Throws Error if the
  // recording could not be written, where the rows so far remain readable, or what is written besides it, where the
  // recording is final all the same.
  RecorderSnapshot finish();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace asperity
