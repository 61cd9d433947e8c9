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

// Serves it until `condition`, which is asked after each tick; false if that takes more than 10 s. For what a busy
// machine may delay: the device's thread is late, or this one was and the force has ended meanwhile.
inline bool serve_until(HapticDevice& device, const std::function<Eigen::Vector3d(const DeviceReading&)>& force,
                        const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    serve(device, 1, force);
  }
  return true;
}

// Waits for `condition`; false if that takes more than 10 s.
inline bool comes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace asperity
