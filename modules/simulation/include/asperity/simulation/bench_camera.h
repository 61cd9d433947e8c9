#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "asperity/image/gray_image.h"
#include "asperity/recording/recording.h"
#include "asperity/simulation/render_tags.h"
#include "asperity/simulation/simulated_camera_config.h"
#include "asperity/simulation/true_motion.h"

namespace asperity {

// When a frame's shutter was open, and the time stamp that the host gives it.
struct FrameTime {
  std::int64_t open_ns = 0;
  std::int64_t close_ns = 0;
  std::int64_t stamp_ns = 0;  // the exposure's middle plus latency and jitter

  std::int64_t middle_ns() const { return open_ns + (close_ns - open_ns) / 2; }
};

// The bench's camera while a recording is made: its frames, one after another, for the whole of the recording's truth.
// Not thread-safe.
class BenchCamera {
 public:
  // `latency_s` and `jitter_s` (rms) are what time stamps are late by. Throws Error as TagRenderer and TrueMotion.
  BenchCamera(const SimulatedCameraConfig& config, const std::vector<MarkerPlacement>& body, const Recording& recording,
              double latency_s, double jitter_s);

  std::size_t frames() const { return times_.size(); }
  const FrameTime& time(std::size_t frame) const { return times_[frame]; }
  void render(std::size_t frame, GrayImage& image);

  // What a tracker without any error would make of all frames: true poses by their time stamps.
  TrackerStream true_poses() const;

 private:
  TrueMotion motion_;
  TagRenderer renderer_;
  std::vector<FrameTime> times_;
};

}  // namespace asperity
