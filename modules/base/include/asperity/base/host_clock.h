#pragma once

#include <cstdint>

namespace asperity {

// The one clock of all time stamps: CLOCK_MONOTONIC, ns, the same in all processes of this machine; V4L2's
// drivers stamp their frames with it too. Realtime-safe: yes.
std::int64_t host_now_ns() noexcept;

}  // namespace asperity
