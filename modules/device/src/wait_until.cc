#include "wait_until.h"

#include <cerrno>
#include <ctime>

#include "asperity/base/host_clock.h"

namespace asperity {

std::int64_t wait_until(std::int64_t due_ns, std::int64_t spin_ns) noexcept {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  std::int64_t now = host_now_ns();
  const std::int64_t wake = due_ns - spin_ns;
  if (now < wake) {
    const timespec until{.tv_sec = wake / kSecond_ns, .tv_nsec = wake % kSecond_ns};
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
    now = host_now_ns();
  }
  while (now < due_ns) now = host_now_ns();
  return now;
}

}  // namespace asperity
