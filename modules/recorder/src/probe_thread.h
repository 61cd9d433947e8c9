#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "asperity/link/probe_source.h"
#include "asperity/recorder/recorder_config.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "bounded_queue.h"
#include "opened_source.h"
#include "sensor_thread.h"

namespace asperity {

// The probe's thread with its queue. Opens the probe at once; throws Error if that fails.
class ProbeThread {
 public:
  ProbeThread(std::function<std::unique_ptr<ProbeSource>()> open, bool reopen, bool reopen_silent,
              const RecorderConfig& config);
  ~ProbeThread() { stop(); }

  void stop() { thread_->stop(); }
  // Returns when the probe has described itself or come to its end, or after `most_s`.
  void wait_for_description(double most_s);
  std::optional<ProbeDescription> description() const;
  void take(std::vector<ProbeSample>& out) { queue_.take(out); }
  // All but the rate.
  void describe(RecorderSnapshot& out) const;

 private:
  bool read(std::chrono::milliseconds timeout);
  void close() noexcept;

  bool waits_;  // for room in the queue
  OpenedSource<ProbeSource> source_;
  std::vector<ProbeSample> samples_;
  BoundedQueue<ProbeSample> queue_;
  mutable std::mutex mutex_;
  std::condition_variable described_;
  LinkStatistics before_;  // of the times that it was open before
  LinkStatistics now_;
  std::optional<ProbeDescription> description_;
  bool ended_ = false;  // a file has come to its end
  std::optional<SensorThread> thread_;
};

}  // namespace asperity
