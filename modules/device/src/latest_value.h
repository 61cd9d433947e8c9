#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace asperity {

// The newest value on its way from one thread to one other. Neither waits, locks nor allocates: of three slots each
// side holds one and the third is exchanged. Values that the reader was too slow for are lost. T is trivially copied.
template <class T>
class LatestValue {
 public:
  // The writer's thread alone.
  void write(const T& value) noexcept {
    slots_[back_] = value;
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  // The reader's thread alone. False, and `value` as it was, if nothing was written since the last read.
  bool read(T& value) noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    value = slots_[front_];
    return true;
  }

 private:
  static constexpr std::uint32_t kIndex = 3, kFresh = 4;

  std::array<T, 3> slots_{};
  std::uint32_t back_ = 0;
  std::uint32_t front_ = 1;
  std::atomic<std::uint32_t> middle_{2};
};

}  // namespace asperity
