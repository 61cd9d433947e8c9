#include "pose_thread.h"

#include <utility>

#include "asperity/base/error.h"

namespace asperity {

PoseThread::PoseThread(std::function<std::unique_ptr<PoseSource>()> open, bool reopen, bool reopen_silent,
                       const RecorderConfig& config)
    : waits_(!reopen), source_(std::move(open), "tracker"), queue_(static_cast<std::size_t>(config.pose_queue)) {
  nominal_rate_Hz_ = source_->nominal_rate_Hz();
  SensorLoop loop;
  loop.open = [this] { source_.open_again(); };
  loop.close = [this] { close(); };
  loop.read = [this](std::chrono::milliseconds timeout) { return read(timeout); };
  loop.reopen = reopen;
  loop.reopen_silent = reopen_silent;
  thread_.emplace(std::move(loop), config);
}

bool PoseThread::read(std::chrono::milliseconds timeout) {
  // A file can wait for the disk; a sensor cannot.
  if (waits_ && !queue_.wait_for_room(timeout)) return true;
  const auto pose = source_->read(timeout);
  if (pose) {
    poses_.push_back(with_sigmas(*pose));
    queue_.push(poses_);
  }
  const TrackingStatistics statistics = source_->statistics();
  constexpr unsigned kReadsPerLook = 64;  // a tracker may come to warn later
  const bool look = reads_++ % kReadsPerLook == 0;
  std::vector<std::string> warnings;
  if (look) warnings = source_->warnings();
  const std::lock_guard lock(mutex_);
  // A tracker that sees no marker is alive as long as its frames come.
  const bool alive = pose.has_value() || statistics.frames != now_.frames;
  now_ = statistics;
  if (look) warnings_ = std::move(warnings);
  return alive;
}

void PoseThread::close() noexcept {
  source_.close();
  const std::lock_guard lock(mutex_);
  before_ = before_ + now_;
  now_ = {};
}

void PoseThread::describe(RecorderSnapshot& out) const {
  describe_sensor(thread_->health(), queue_.counts(), out.poses);
  out.poses.name = source_.name();
  const std::lock_guard lock(mutex_);
  out.tracking = before_ + now_;
  out.poses.warnings = warnings_;
}

}  // namespace asperity
