#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "asperity/device/device_frame.h"
#include "asperity/device/haptic_device.h"
#include "asperity/device/safety_config.h"
#include "asperity/device/servo_statistics.h"
#include "asperity/device/servo_tick.h"
#include "asperity/device/snapshot_exchange.h"
#include "asperity/render/render_model.h"

namespace asperity {

// What to do about real-time priority.
enum class RealTimePriority {
  kIgnore,   // run as the process does
  kTry,      // ask for it; the statistics tell whether it was granted
  kEnforce,  // Error if it is not granted
};

struct ServoConfig {
  double rate_Hz = 1000.0;  // 100 to 4000
  double duration_s = 0.0;  // 0: until stopped or until the device ends
  bool paced = true;        // by the clock; false: as fast as it goes, for simulated devices
  bool timed = false;       // measure each step
  RealTimePriority priority = RealTimePriority::kTry;
  double spin_s = 50e-6;  // wakes this long before the tick and spins
  DeviceFrame frame;
  SafetyConfig safety;
};

// How a run ended.
enum class ServoEnd { kDuration, kDeviceEnded, kStopped, kFault };

struct ServoResult {
  ServoEnd end = ServoEnd::kDuration;
  ServoStatistics statistics;
};

// Runs the loop until its end: read, render, make safe, write, once a tick. The calling thread waits; ticks run on a
// thread of their own when paced. `on_tick` gets every tick in order, on the calling thread, outside the
// servo thread's time; it may allocate and write files. The device has zero force when this returns or throws.
// Throws Error for a config out of range, and if the priority is enforced but not granted.
ServoResult run_servo(HapticDevice& device, SnapshotExchange<const RenderModel>& scene, const ServoConfig& config,
                      const std::atomic<bool>& stop, const std::function<void(const ServoTick&)>& on_tick);

}  // namespace asperity
