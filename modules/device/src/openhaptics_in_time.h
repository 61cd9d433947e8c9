#pragma once

#include <memory>

#include "asperity/device/openhaptics_device.h"

namespace asperity {

// With the process's end it must be less than the 150 ms that are promised (docs/safety.md).
inline constexpr double kOpenHapticsHangAfter_s = 0.1;

// open_openhaptics(), with another time after which a driver that does not return is ended: for tests, whose driver is
// a fake without real-time priority on a busy machine.
std::unique_ptr<HapticDevice> open_openhaptics_in_time(const OpenHapticsConfig& config, double hang_after_s);

}  // namespace asperity
