#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <mutex>
#include <vector>

namespace asperity {

struct QueueCounts {
  double fill = 0.0;  // share
  double highest_fill = 0.0;
  std::uint64_t overflowed = 0;  // rows dropped
  std::uint64_t received = 0;    // rows
};

// Rows from a sensor's thread to the writing one. Neither waits for the other for longer than a copy takes: the
// writer takes all at once, and what does not fit is dropped and counted.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) { waiting_.reserve(capacity); }

  // Empties `batch`.
  void push(std::vector<T>& batch) {
    {
      const std::lock_guard lock(mutex_);
      const std::size_t fits = std::min(batch.size(), capacity_ - waiting_.size());
      waiting_.insert(waiting_.end(), std::make_move_iterator(batch.begin()),
                      std::make_move_iterator(batch.begin() + static_cast<std::ptrdiff_t>(fits)));
      overflowed_ += batch.size() - fits;
      received_ += batch.size();
      highest_ = std::max(highest_, waiting_.size());
    }
    batch.clear();
  }

  // Waits at most `timeout` until half of it is free; for a source that can wait itself. False if it did not come.
  bool wait_for_room(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    return emptied_.wait_for(lock, timeout, [this] { return 2 * waiting_.size() <= capacity_; });
  }

  // Puts all that wait into `out`, whose own rows are lost and whose memory is used in turn.
  void take(std::vector<T>& out) {
    out.clear();
    out.reserve(capacity_);
    {
      const std::lock_guard lock(mutex_);
      waiting_.swap(out);
    }
    emptied_.notify_one();
  }

  QueueCounts counts() const {
    const std::lock_guard lock(mutex_);
    const auto share = [this](std::size_t rows) { return static_cast<double>(rows) / static_cast<double>(capacity_); };
    return {share(waiting_.size()), share(highest_), overflowed_, received_};
  }

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable emptied_;
  std::vector<T> waiting_;
  std::size_t highest_ = 0;
  std::uint64_t overflowed_ = 0;
  std::uint64_t received_ = 0;
};

}  // namespace asperity
