#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asperity/tracking/tracked_pose.h"

namespace asperity {

// What a tracker has seen so far. All counts only rise.
struct TrackingStatistics {
  std::uint64_t frames = 0;
  std::uint64_t poses = 0;           // frames in which the body was found
  std::uint64_t skipped_frames = 0;  // passed over because a newer one was there
};

// Of both, one after the other.
inline TrackingStatistics& operator+=(TrackingStatistics& a, const TrackingStatistics& b) {
  a.frames += b.frames;
  a.poses += b.poses;
  a.skipped_frames += b.skipped_frames;
  return a;
}
inline TrackingStatistics operator+(TrackingStatistics a, const TrackingStatistics& b) { return a += b; }

// Where poses of the marker body come from: a camera with a tracker, another tracker's stream, a file. One
// thread at a time.
class PoseSource {
 public:
  virtual ~PoseSource() = default;

  // Waits at most `timeout` for the next frame; nullopt if none came or the body was not seen in it.
  // Throws LinkLost when no more can come, Error for anything else that fails.
  virtual std::optional<TrackedPose> read(std::chrono::milliseconds timeout) = 0;

  virtual TrackingStatistics statistics() const = 0;
  virtual double nominal_rate_Hz() const { return 0.0; }  // 0: unknown
  virtual std::string name() const = 0;
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace asperity
