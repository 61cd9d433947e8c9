#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "asperity/device/device_frame.h"
#include "asperity/device/force_permit.h"
#include "asperity/device/haptic_device.h"
#include "asperity/device/reflexes.h"
#include "asperity/device/safety_config.h"
#include "asperity/device/servo_statistics.h"
#include "asperity/device/servo_tick.h"
#include "asperity/device/snapshot_exchange.h"
#include "asperity/render/device_state.h"
#include "asperity/render/render_model.h"
#include "asperity/render/render_step.h"
#include "asperity/render/servo_output.h"
#include "asperity/render/servo_state.h"

namespace asperity {

// What to do about real-time priority.
enum class RealTimePriority {
  kIgnore,   // run as the process does
  kTry,      // ask for it; the statistics state whether it was granted
  kEnforce,  // Error if it is not granted
};

inline constexpr std::array<std::string_view, 3> kRealTimePriorityNames{"ignore", "try", "enforce"};

struct ServoConfig {
  double rate_Hz = 1000.0;  // 100 to 4000
  double duration_s = 0.0;  // 0: until stopped or until the device ends
  bool paced = true;        // by the clock; false: as fast as it goes, for simulated devices
  bool timed = false;       // measure each step
  RealTimePriority priority = RealTimePriority::kTry;
  double spin_s = 50e-6;            // wakes this long before the tick and spins
  double velocity_noise_m = 20e-6;  // of positions, for devices that give no velocity
  DeviceFrame frame;
  SafetyConfig safety;
  ReflexConfig reflexes;

  template <class V>
  void visit(V& v) {
    v.field("rate_Hz", rate_Hz, "ticks a second", {100.0, 4000.0});
    v.field("duration_s", duration_s, "0: until stopped or until the device ends", {0.0, 1e6});
    v.field("paced", paced, "by the clock; false: as fast as it goes");
    v.field("timed", timed, "measure each step");
    v.choice("priority", priority, kRealTimePriorityNames, "real-time priority");
    v.field("spin_s", spin_s, "spin for so long before a tick", {0.0, 0.001});
    v.field("velocity_noise_m", velocity_noise_m, "of positions, where a device gives no velocity", {0.0, 0.01});
    v.group("frame", frame);
    v.group("safety", safety);
    v.group("reflexes", reflexes);
  }
};

// How a run ended.
enum class ServoEnd { kDuration, kDeviceEnded, kStopped, kFault };

struct ServoResult {
  ServoEnd end = ServoEnd::kDuration;
  ReflexFault fault = ReflexFault::kNone;  // of the loop's own, with kFault
  ServoStatistics statistics;
  std::vector<ServoTick> last_ticks;  // of the last 2 s, in order: the flight recorder
};

// A renderer's step: render_step, or a test's replacement.
using ServoStep = ServoOutput (*)(const RenderModel&, ServoState&, const DeviceState&) noexcept;

// Runs the loop until its end: read, render, make safe, write, once a tick. The calling thread waits; ticks run on a
// thread of their own when paced. `on_tick` gets every tick in order, on the calling thread, outside the
// servo thread's time; it may allocate and write files. The device has zero force when this returns or throws.
//
// Tick k is due at k/rate_Hz after the start, ServoTick::t_ns = round(k · 1e9 / rate_Hz). Due times that pass while a
// tick is late are skipped, never caught up with. A run that is stopped or whose duration is over goes on for
// SafetyConfig::ramp_down_s until its force is zero; those ticks carry SafetyCause::kEnding. One whose device ends or
// has a fault ends at once, as one of a device that pushes a hand does if its readings cannot be true, or the loop or
// the machine stood still (reflexes.h). If `on_tick` throws, the run is stopped and the exception passed on.
//
// Not paced, everything runs on the calling thread, no tick is lost, and the same device, scene and config give
// the same bits: DeviceState::dt_s is 1/rate_Hz.
// With a `permit` the force is there only while it is given, and within its limit.
// Throws Error for a config out of range, and if the priority is enforced but not granted.
ServoResult run_servo(HapticDevice& device, SnapshotExchange<const RenderModel>& scene, const ServoConfig& config,
                      const std::atomic<bool>& stop, const std::function<void(const ServoTick&)>& on_tick,
                      ServoStep step = &render_step, const ForcePermit* permit = nullptr);

}  // namespace asperity
