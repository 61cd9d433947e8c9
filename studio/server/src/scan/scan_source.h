#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "asperity/camera/camera_source.h"
#include "asperity/recorder/recorder.h"
#include "asperity/recording/calibration.h"
#include "asperity/recording/recording.h"
#include "asperity/tracking/track_body.h"

namespace asperity::studio {

// Where a scan's rows come from. Made and opened in a job, ended when the recorder that reads it has ended.
class ScanSource {
 public:
  virtual ~ScanSource() = default;

  // For the recorder. `on_frame` is given the camera's images in the thread that reads them. Called once. Throws Error.
  virtual RecorderSensors sensors(const TrackConfig& track,
                                  const std::function<void(const CameraFrame&)>& on_frame) = 0;
  virtual const std::optional<Calibration>& calibration() const = 0;
  // What the recorder cannot know: object, world, gravity until it is measured, extra.
  virtual RecordingInfo info() const = 0;
  // What the recorder has to know of it: a bench need not wait for its disk, a probe may be slow to speak.
  virtual void adapt(RecorderConfig&) const {}

  // A source that waits for its start, plays once, and waits again; hardware does not. Thread-safe.
  virtual bool plays() const { return false; }
  virtual void play() {}
  virtual void stop_playing() {}
  virtual bool playing() const { return true; }
};

}  // namespace asperity::studio
