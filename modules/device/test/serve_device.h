#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

#include "asperity/device/haptic_device.h"

namespace asperity {

// Serves the device at 1 kHz for `ticks`; `force` makes the force from the reading.
inline void serve(HapticDevice& device, int ticks, const std::function<Eigen::Vector3d(const DeviceReading&)>& force) {
  static std::int64_t tick = 0;
  auto due = std::chrono::steady_clock::now();
  for (int i = 0; i < ticks; ++i) {
    device.write(force(device.read(++tick * 1000000)));
    due += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(due);
  }
}

}  // namespace asperity
