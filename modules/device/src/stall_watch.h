#pragma once

#include <cstdint>

namespace asperity {

// Tells from a device's sequence, tick by tick, when nothing new has come for too long. Times are the schedule's.
class StallWatch {
 public:
  explicit StallWatch(double stall_after_s) : limit_ns_(static_cast<std::int64_t>(stall_after_s * 1e9)) {}

  bool stalled(std::int64_t t_ns, std::uint64_t sequence) noexcept {
    if (!begun_ || sequence != newest_) {
      begun_ = true;
      newest_ = sequence;
      since_ns_ = t_ns;
    }
    return t_ns - since_ns_ > limit_ns_;
  }

 private:
  std::int64_t limit_ns_;
  std::int64_t since_ns_ = 0;
  std::uint64_t newest_ = 0;
  bool begun_ = false;
};

}  // namespace asperity
