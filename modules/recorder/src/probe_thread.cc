#include "probe_thread.h"

#include <exception>
#include <utility>

#include "asperity/base/error.h"

namespace asperity {

ProbeThread::ProbeThread(std::function<std::unique_ptr<ProbeSource>()> open, bool reopen, bool reopen_silent,
                         const RecorderConfig& config)
    : waits_(!reopen), source_(std::move(open), "probe"), queue_(static_cast<std::size_t>(config.probe_queue)) {
  SensorLoop loop;
  loop.open = [this] { source_.open_again(); };
  loop.close = [this] { close(); };
  loop.read = [this](std::chrono::milliseconds timeout) { return read(timeout); };
  loop.reopen = reopen;
  loop.reopen_silent = reopen_silent;
  thread_.emplace(std::move(loop), config);
}

bool ProbeThread::read(std::chrono::milliseconds timeout) {
  // A file can wait for the disk; a sensor cannot.
  if (waits_ && !queue_.wait_for_room(timeout)) return true;
  std::exception_ptr lost;
  try {
    source_->read(samples_, timeout);
  } catch (const Error&) {
    lost = std::current_exception();  // after what had come before
  }
  const bool alive = !samples_.empty();
  const LinkStatistics statistics = source_->statistics();
  auto description = source_->description();
  if (alive) queue_.push(samples_);
  {
    const std::lock_guard lock(mutex_);
    now_ = statistics;
    if (description) description_ = std::move(description);
    ended_ = waits_ && lost;
  }
  described_.notify_all();
  if (lost) std::rethrow_exception(lost);
  return alive;
}

void ProbeThread::close() noexcept {
  source_.close();
  const std::lock_guard lock(mutex_);
  before_ = before_ + now_;
  now_ = {};
}

void ProbeThread::wait_for_description(double most_s) {
  std::unique_lock lock(mutex_);
  described_.wait_for(lock, std::chrono::duration<double>(most_s),
                      [this] { return description_.has_value() || ended_; });
}

std::optional<ProbeDescription> ProbeThread::description() const {
  const std::lock_guard lock(mutex_);
  return description_;
}

void ProbeThread::describe(RecorderSnapshot& out) const {
  describe_sensor(thread_->health(), queue_.counts(), out.probe);
  out.probe.name = source_.name();
  const std::lock_guard lock(mutex_);
  out.link = before_ + now_;
}

}  // namespace asperity
