#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "asperity/device/servo_tick.h"

namespace asperity {

// The last ticks of a run, in memory of fixed size that is taken at the start.
class FlightRecorder {
 public:
  explicit FlightRecorder(std::size_t ticks) : ticks_(std::max<std::size_t>(ticks, 1)) {}

  // Realtime-safe: yes.
  void push(const ServoTick& tick) noexcept {
    ticks_[next_] = tick;
    next_ = next_ + 1 == ticks_.size() ? 0 : next_ + 1;
    count_ = std::min(count_ + 1, ticks_.size());
  }

  // What is held, oldest first; the recorder is empty afterwards.
  std::vector<ServoTick> take() {
    if (count_ == ticks_.size()) {
      std::rotate(ticks_.begin(), ticks_.begin() + static_cast<std::ptrdiff_t>(next_), ticks_.end());
    } else {
      ticks_.resize(count_);
    }
    next_ = 0;
    count_ = 0;
    return std::exchange(ticks_, std::vector<ServoTick>(1));
  }

 private:
  std::vector<ServoTick> ticks_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace asperity
