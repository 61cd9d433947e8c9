#include "asperity/base/host_clock.h"

#include <ctime>

namespace asperity {

std::int64_t host_now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

}  // namespace asperity
