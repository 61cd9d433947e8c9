#include "feel/run_log.h"

#include <exception>
#include <utility>

namespace asperity::studio {

void RunLog::begin(std::unique_ptr<FeelLog> log) {
  const std::lock_guard lock(lock_);
  next_ = std::move(log);
  ordered_.store(true);
}

void RunLog::end() {
  const std::lock_guard lock(lock_);
  end_ = true;
  ordered_.store(true);
}

void RunLog::take_orders() {
  std::shared_ptr<FeelLog> next;
  bool end = false;
  {
    const std::lock_guard lock(lock_);
    next = std::move(next_);
    end = std::exchange(end_, false);
    ordered_.store(false);
  }
  if (next) {
    log_ = std::move(next);
    rows_ = 0;
  }
  if (end && log_) ended_({std::move(log_), {}});
}

void RunLog::add(const ServoTick& tick) {
  if (ordered_.load()) take_orders();
  if (!log_) return;
  try {
    log_->add(tick);
    if (++rows_ >= kMostRows) ended_({std::move(log_), {}});
  } catch (const std::exception& fault) {
    log_.reset();
    ended_({nullptr, fault.what()});
  }
}

void RunLog::finish() {
  if (ordered_.load()) take_orders();
  if (log_) ended_({std::move(log_), {}});
}

}  // namespace asperity::studio
