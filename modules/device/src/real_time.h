#pragma once

#include <cstdint>
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
  int error() const noexcept { return error_; }  // errno of a refusal; 0 if held or not wanted

 private:
  bool held_ = false;
  int error_ = 0;
};

// Asks for SCHED_FIFO for the calling thread; false if it is not granted, `why` then says why.
bool take_real_time_priority(std::string& why);

// Timers of the calling thread fire as precisely as the kernel can; by default it lets them be 50 µs late.
void take_precise_timers() noexcept;

// Sleeps to `spin_ns` before `due_ns` of host_now_ns(), spins for the rest, and returns the time at which it ended.
std::int64_t wait_until(std::int64_t due_ns, std::int64_t spin_ns) noexcept;

}  // namespace asperity
