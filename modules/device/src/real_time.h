#pragma once

#include <string>

namespace asperity {

// Keeps the process's memory from being swapped out while it lives, as far as the limits of the process allow.
class MemoryLock {
 public:
  explicit MemoryLock(bool wanted) noexcept;
  ~MemoryLock();
  MemoryLock(const MemoryLock&) = delete;
  MemoryLock& operator=(const MemoryLock&) = delete;

  bool held() const noexcept { return held_; }

 private:
  bool held_ = false;
};

// Asks for SCHED_FIFO for the calling thread; false if it is not granted, `why` then says why.
bool take_real_time_priority(std::string& why);

// Timers of the calling thread fire as precisely as the kernel can; by default it lets them be 50 µs late.
void take_precise_timers() noexcept;

}  // namespace asperity
