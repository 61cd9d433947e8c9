#pragma once

#include <cstdint>

#include "asperity/device/duration_histogram.h"
#include "asperity/device/make_safe.h"
#include "asperity/device/reflexes.h"
#include "asperity/device/servo_loop.h"
#include "asperity/device/velocity_estimator.h"
#include "flight_recorder.h"

namespace asperity {

// Where ticks go besides the flight recorder: false if there was no room.
class TickSink {
 public:
  virtual ~TickSink() = default;
  virtual bool take(const ServoTick& tick) = 0;
};

// The due time of tick `k`, from the start of the run.
std::int64_t due_ns(std::uint64_t k, double rate_Hz) noexcept;

// What happens at each tick, whoever paces it. No clock but for the duration of a timed step.
class ServoCore {
 public:
  ServoCore(HapticDevice& device, SnapshotExchange<const RenderModel>& scene, const ServoConfig& config, ServoStep step,
            const ForcePermit* permit);

  // Tick `k`, by its schedule `ticks_since` after the tick before, started `late_ns` after it was due. True if the
  // run goes on; if not, the device has zero force. `suspended`: the machine was, since the tick before.
  bool tick(std::uint64_t k, std::uint64_t ticks_since, std::int64_t late_ns, bool stop_asked, TickSink& sink,
            bool suspended = false);

  void count_overrun() noexcept { ++statistics_.overruns; }
  void count_skipped(std::uint64_t ticks) noexcept { statistics_.skipped += ticks; }
  void set_real_time(bool granted) noexcept { statistics_.real_time = granted; }
  void set_memory_lock(bool held, int error) noexcept {
    statistics_.memory_locked = held;
    statistics_.memory_error = error;
  }
  ServoResult take_result();

 private:
  void begin_ending(ServoEnd end) noexcept;
  // A fault of the loop's own; the first one counts.
  void judge(const DeviceReading& reading, double dt_s, bool suspended) noexcept;
  SafeForce make_safe_now(SafetyInput input) noexcept;
  ServoOutput render(const DeviceReading& reading, const Eigen::Vector3d& v_device_mps, double dt_s,
                     ServoTick& tick) noexcept;

  HapticDevice& device_;
  SnapshotExchange<const RenderModel>& scene_;
  const ServoConfig& config_;
  SafetyConfig safety_config_;
  ServoStep step_;
  const ForcePermit* permit_;  // null: always permitted
  PermitWatch permit_watch_;
  std::uint64_t duration_ticks_;  // 0: no end

  ServoState servo_;
  SafetyState safety_;
  ReflexConfig reflexes_;
  ReflexState reflex_;
  LostTicks lost_;
  bool judged_;  // a computed hand is not
  bool plausible_ = true;
  ReflexFault fault_ = ReflexFault::kNone;
  VelocityEstimator velocity_;
  const RenderModel* model_ = nullptr;
  bool scene_changed_ = false;
  bool ending_ = false;
  ServoEnd end_ = ServoEnd::kDuration;
  ServoStatistics statistics_;
  DurationHistogram late_;
  DurationHistogram step_time_;
  FlightRecorder recorder_;
};

}  // namespace asperity
