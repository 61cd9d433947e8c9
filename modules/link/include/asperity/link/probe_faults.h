#pragma once

#include <cstdint>
#include <string>

namespace asperity {

// What an open probe has last stated about its sensors (docs/probe-protocol.md, type 03h). Counts are since the probe
// was switched on.
struct ProbeFaults {
  std::uint8_t imu_state = 0;  // 0: it works
  std::uint8_t force_state = 0;
  std::uint32_t imu_bus_failures = 0;
  std::uint32_t imu_overflows = 0;
  std::uint32_t imu_lost_sync = 0;
  std::uint32_t imu_invalid_rows = 0;
  std::uint32_t imu_restarts = 0;
  std::uint32_t force_bus_failures = 0;
  std::uint32_t force_skipped = 0;
  std::uint32_t force_restarts = 0;

  bool operator==(const ProbeFaults&) const = default;
  bool any() const { return !(*this == ProbeFaults{}); }
};

// In words, for a message: "inertial sensor: not found, 3 bus failures; force sensor: 1 restart". Empty without a
// fault.
std::string describe_faults(const ProbeFaults& faults);

}  // namespace asperity
