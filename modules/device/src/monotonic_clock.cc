#include "monotonic_clock.h"

#include <cerrno>
#include <ctime>

namespace asperity {

std::int64_t monotonic_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

std::int64_t wait_until(std::int64_t due_ns, std::int64_t spin_ns) noexcept {
  std::int64_t now = monotonic_ns();
  const std::int64_t wake = due_ns - spin_ns;
  if (now < wake) {
    const timespec until{.tv_sec = wake / kSecond_ns, .tv_nsec = wake % kSecond_ns};
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
    now = monotonic_ns();
  }
  while (now < due_ns) now = monotonic_ns();
  return now;
}

}  // namespace asperity
