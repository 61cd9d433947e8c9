#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

namespace asperity {

// A queue of fixed capacity from one thread to one other. Neither side locks, waits or allocates. When it is full,
// push() refuses.
template <class T>
class SpscRing {  // NOLINT(clang-analyzer-optin.performance.Padding): each side writes to a cache line of its own
 public:
  // Room for `capacity` items, rounded up to a power of two; all memory is taken and touched here.
  explicit SpscRing(std::size_t capacity) : items_(std::bit_ceil(capacity > 0 ? capacity : 1)) {}
  SpscRing(const SpscRing&) = delete;
  SpscRing& operator=(const SpscRing&) = delete;

  // The producer's thread alone. False, and nothing queued, if there is no room. Realtime-safe: yes.
  bool push(const T& item) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) == items_.size()) return false;
    items_[tail & (items_.size() - 1)] = item;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  // The consumer's thread alone. False if there is none. Realtime-safe: yes.
  bool pop(T& item) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    item = items_[head & (items_.size() - 1)];
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  // The consumer's thread alone: how many it can pop at least. Realtime-safe: yes.
  std::size_t size() const noexcept {
    return tail_.load(std::memory_order_acquire) - head_.load(std::memory_order_relaxed);
  }

  std::size_t capacity() const noexcept { return items_.size(); }

 private:
  static constexpr std::size_t kCacheLine_bytes = 64;

  std::vector<T> items_;
  alignas(kCacheLine_bytes) std::atomic<std::size_t> head_{0};  // taken so far; wraps
  alignas(kCacheLine_bytes) std::atomic<std::size_t> tail_{0};  // queued so far; wraps
};

}  // namespace asperity
