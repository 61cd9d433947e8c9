#pragma once

#include <cstdint>

namespace asperity {

// Sleeps to `spin_ns` before `due_ns` of host_now_ns(), spins for the rest, and returns the time at which it ended.
std::int64_t wait_until(std::int64_t due_ns, std::int64_t spin_ns) noexcept;

}  // namespace asperity
