#include "real_time.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "asperity/base/host_clock.h"

namespace asperity {
namespace {

// Above the kernel's threads for interrupts (50), below its watchdogs (99).
constexpr int kPriority = 70;

}  // namespace

MemoryLock::MemoryLock(bool wanted) noexcept {
  if (!wanted) return;
  rlimit limit{};
  ::getrlimit(RLIMIT_MEMLOCK, &limit);
  // With a limit, memory that is asked for later would be refused instead of just not being locked.
  const bool unlimited = limit.rlim_cur == RLIM_INFINITY || ::geteuid() == 0;
  held_ = ::mlockall(unlimited ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) == 0;
  if (!held_) error_ = errno;
}

MemoryLock::~MemoryLock() {
  if (held_) ::munlockall();
}

bool take_real_time_priority(std::string& why) {
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters);
  if (error != 0) why = std::strerror(error);
  return error == 0;
}

void take_precise_timers() noexcept { ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL); }

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
