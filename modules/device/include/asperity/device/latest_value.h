#pragma once

#include <array>
#include <atomic>

namespace asperity {

// Passes the newest of a series of values from one thread to another: one writer, one reader, no lock, no wait, no
// allocation, never a torn value. Three places: the writer fills its own and exchanges it with the middle one, the
// reader exchanges its own with the middle one if that is news. T is plain data.
template <class T>
class LatestValue {
 public:
  explicit LatestValue(const T& first = T()) { slots_.fill(first); }
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  // The writer's thread alone.
  void publish(const T& value) noexcept {
    slots_[written_] = value;
    written_ = middle_.exchange(written_ | kNews, std::memory_order_acq_rel) & ~kNews;
  }

  // The reader's thread alone: the newest value, the first one if nothing was published; valid until its next take().
  const T& take() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kNews) != 0) {
      read_ = middle_.exchange(read_, std::memory_order_acq_rel) & ~kNews;
    }
    return slots_[read_];
  }

  // The reader's thread alone: the same into `value`, and true; false, and `value` as it was, if there is no news.
  bool take_if_new(T& value) noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kNews) == 0) return false;
    value = take();
    return true;
  }

 private:
  static constexpr unsigned kNews = 4;
  std::array<T, 3> slots_;
  unsigned written_ = 0;  // the writer's
  std::atomic<unsigned> middle_{1};
  unsigned read_ = 2;  // the reader's
};

}  // namespace asperity
