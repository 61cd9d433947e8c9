#pragma once

#include <array>
#include <atomic>
#include <cstddef>

namespace asperity {

// Forces in order from one thread to one other; what comes when it is full is lost. Neither side waits or allocates.
class ForceRing {
 public:
  static constexpr std::size_t kCapacity = 4096;

  // The writer's thread alone.
  void push(double value) noexcept {
    const std::size_t written = written_.load(std::memory_order_relaxed);
    if (written - read_.load(std::memory_order_acquire) == kCapacity) return;
    values_[written % kCapacity] = value;
    written_.store(written + 1, std::memory_order_release);
  }

  // The reader's thread alone.
  bool pop(double& value) noexcept {
    const std::size_t read = read_.load(std::memory_order_relaxed);
    if (read == written_.load(std::memory_order_acquire)) return false;
    value = values_[read % kCapacity];
    read_.store(read + 1, std::memory_order_release);
    return true;
  }
  std::size_t size() const noexcept {
    return written_.load(std::memory_order_acquire) - read_.load(std::memory_order_relaxed);
  }

 private:
  std::array<double, kCapacity> values_{};
  alignas(64) std::atomic<std::size_t> written_{0};
  alignas(64) std::atomic<std::size_t> read_{0};
};

}  // namespace asperity
