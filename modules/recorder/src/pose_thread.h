#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "asperity/recorder/recorder_config.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "asperity/tracking/pose_source.h"
#include "bounded_queue.h"
#include "opened_source.h"
#include "sensor_thread.h"

namespace asperity {

// The tracker's thread with its queue. Opens the tracker at once; throws Error if that fails.
class PoseThread {
 public:
  PoseThread(std::function<std::unique_ptr<PoseSource>()> open, bool reopen, bool reopen_silent,
             const RecorderConfig& config);
  ~PoseThread() { stop(); }

  void stop() { thread_->stop(); }
  double nominal_rate_Hz() const { return nominal_rate_Hz_; }
  void take(std::vector<TrackerSample>& out) { queue_.take(out); }
  // All but the rate.
  void describe(RecorderSnapshot& out) const;

 private:
  bool read(std::chrono::milliseconds timeout);
  void close() noexcept;

  bool waits_;  // for room in the queue
  OpenedSource<PoseSource> source_;
  std::vector<TrackerSample> poses_;
  BoundedQueue<TrackerSample> queue_;
  double nominal_rate_Hz_ = 0.0;
  mutable std::mutex mutex_;
  TrackingStatistics before_;  // of the times that it was open before
  TrackingStatistics now_;
  std::vector<std::string> warnings_;
  unsigned reads_ = 0;
  std::optional<SensorThread> thread_;
};

}  // namespace asperity
