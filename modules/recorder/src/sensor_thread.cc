#include "sensor_thread.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "asperity/transport/byte_source.h"

namespace asperity {

namespace {

constexpr std::chrono::milliseconds kReadTimeout{50};

}  // namespace

SensorThread::SensorThread(SensorLoop loop, const RecorderConfig& config)
    : loop_(std::move(loop)), config_(config), retry_(config.first_retry_s), thread_([this] { run(); }) {}

void SensorThread::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

SensorThread::Health SensorThread::health() const {
  const std::lock_guard lock(mutex_);
  return health_;
}

bool SensorThread::stopping() const {
  const std::lock_guard lock(mutex_);
  return stop_;
}

bool SensorThread::wait(std::chrono::duration<double> time) {
  std::unique_lock lock(mutex_);
  return !changed_.wait_for(lock, time, [this] { return stop_; });
}

void SensorThread::run() {
  while (!stopping()) {
    if (open_) {
      read_once();
    } else if (!loop_.reopen) {
      break;
    } else if (wait(retry_)) {
      open_again();
    }
  }
  if (open_) loop_.close();
}

void SensorThread::read_once() {
  bool alive = false;
  try {
    alive = loop_.read(kReadTimeout);
  } catch (const std::exception& error) {
    const bool is_end = dynamic_cast<const LinkLost*>(&error) != nullptr;
    lose(error.what());
    const std::lock_guard lock(mutex_);
    health_.failed = !loop_.reopen && !is_end;
    return;
  }
  const Clock::time_point now = Clock::now();
  if (alive) {
    alive_at_ = now;
    retry_ = std::chrono::duration<double>(config_.first_retry_s);
    const std::lock_guard lock(mutex_);
    if (health_.state == SensorState::kLost) ++health_.returned;
    health_.state = SensorState::kRunning;
    health_.message.clear();
  } else if (loop_.reopen && now - alive_at_ > std::chrono::duration<double>(config_.stale_s)) {
    constexpr const char* kSilent = "nothing comes";
    if (loop_.reopen_silent) {
      lose(kSilent);
    } else {
      report_lost(kSilent);
    }
  }
}

void SensorThread::lose(const std::string& why) {
  loop_.close();
  open_ = false;
  report_lost(why);
}

void SensorThread::report_lost(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (health_.state != SensorState::kLost) ++health_.lost;
  health_.state = loop_.reopen ? SensorState::kLost : SensorState::kEnded;
  health_.message = why;
}

void SensorThread::open_again() {
  retry_ = std::min(2.0 * retry_, std::chrono::duration<double>(config_.longest_retry_s));
  try {
    loop_.open();
    open_ = true;
    alive_at_ = Clock::now();
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    health_.message = error.what();
  }
}

}  // namespace asperity
