#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace asperity::studio {

// What a source plays now, stated to the sensors' threads that read it: each playing is an episode with a number of its
// own. Thread-safe.
template <class What>
class Episodes {
 public:
  struct Episode {
    std::uint64_t number = 0;
    What what;
  };

  void begin(What what) {
    {
      const std::lock_guard lock(mutex_);
      now_ = Episode{++begun_, std::move(what)};
    }
    changed_.notify_all();
  }
  void end() {
    {
      const std::lock_guard lock(mutex_);
      now_.reset();
    }
    changed_.notify_all();
  }
  std::optional<Episode> now() const {
    const std::lock_guard lock(mutex_);
    return now_;
  }
  // One that is newer than `number`, as soon as there is one; nullopt after `timeout`.
  std::optional<Episode> wait_newer(std::uint64_t number, std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [&] { return now_ && now_->number > number; });
    return now_ && now_->number > number ? now_ : std::nullopt;
  }
  // Returns at `until`, or earlier when something has changed.
  void wait_change(std::uint64_t number, std::chrono::steady_clock::time_point until) const {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, until, [&] { return !now_ || now_->number != number; });
  }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::optional<Episode> now_;
  std::uint64_t begun_ = 0;
};

}  // namespace asperity::studio
