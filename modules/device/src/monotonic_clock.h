#pragma once

#include <cstdint>

namespace asperity {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

// CLOCK_MONOTONIC. Realtime-safe: yes.
std::int64_t monotonic_ns() noexcept;

// Sleeps to `spin_ns` before `due_ns` of CLOCK_MONOTONIC, spins for the rest, and returns the time at which it ended.
std::int64_t wait_until(std::int64_t due_ns, std::int64_t spin_ns) noexcept;

}  // namespace asperity
