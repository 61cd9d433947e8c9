#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <utility>

namespace asperity::studio {

// What other threads need done on the studio's thread, in order. Functions are thread-safe.
class Inbox {
 public:
  using Work = std::function<void()>;

  void post(Work work) {
    {
      const std::lock_guard lock(mutex_);
      if (closed_) return;
      works_.push_back(std::move(work));
    }
    woken_.notify_one();
  }

  // What has come by `until` at the latest, as soon as there is something.
  std::deque<Work> wait(std::chrono::steady_clock::time_point until) {
    std::unique_lock lock(mutex_);
    woken_.wait_until(lock, until, [&] { return !works_.empty(); });
    return std::exchange(works_, {});
  }

  // Drops what waits, and all that comes from now on.
  void close() {
    std::deque<Work> dropped;
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
      dropped = std::exchange(works_, {});
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable woken_;
  std::deque<Work> works_;
  bool closed_ = false;
};

}  // namespace asperity::studio
