#include "asperity/device/servo_loop.h"

#include <exception>
#include <future>
#include <string>
#include <thread>

#include "asperity/base/config.h"
#include "asperity/base/error.h"
#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/device/supervisor.h"
#include "real_time.h"
#include "run_servo_on.h"
#include "servo_core.h"
#include "spsc_queue.h"

namespace asperity {
namespace {

constexpr double kQueue_s = 4.0;  // ticks that on_tick may be behind
constexpr auto kDrainEvery = std::chrono::milliseconds(2);
constexpr std::int64_t kLead_ns = 2'000'000;  // from the thread's start to the first tick

void check_servo_config(const ServoConfig& config) {
  ServoConfig copy = config;
  for (const ConfigField& field : list_fields("servo", copy)) {
    if (field.type == FieldType::kNumber) field.set(field.get());
  }
  const double length = config.frame.R_world_device.norm();
  if (!(length > 1.0 - 1e-6 && length < 1.0 + 1e-6)) {
    throw Error("servo.frame.R_world_device_xyzw: a quaternion of length " + number_text(length) +
                " is not a rotation");
  }
  if (!config.frame.translation_m.allFinite()) throw Error("servo.frame.translation_m: not finite");
}

// Zero force however the run ends.
class ForceGuard {
 public:
  explicit ForceGuard(HapticDevice& device) noexcept : device_(device) {}
  ~ForceGuard() { device_.write(Eigen::Vector3d::Zero()); }
  ForceGuard(const ForceGuard&) = delete;
  ForceGuard& operator=(const ForceGuard&) = delete;

 private:
  HapticDevice& device_;
};

class DirectSink final : public TickSink {
 public:
  explicit DirectSink(const std::function<void(const ServoTick&)>& on_tick) : on_tick_(on_tick) {}
  bool take(const ServoTick& tick) override {
    if (on_tick_) on_tick_(tick);
    return true;
  }

 private:
  const std::function<void(const ServoTick&)>& on_tick_;
};

class QueueSink final : public TickSink {
 public:
  explicit QueueSink(std::size_t ticks) : queue_(ticks) {}
  bool take(const ServoTick& tick) override { return queue_.push(tick); }
  SpscQueue<ServoTick>& queue() { return queue_; }

 private:
  SpscQueue<ServoTick> queue_;
};

void run_unpaced(ServoCore& core, const std::atomic<bool>& stop, const std::function<void(const ServoTick&)>& on_tick) {
  DirectSink sink(on_tick);
  for (std::uint64_t k = 0; core.tick(k, 1, 0, stop.load(std::memory_order_relaxed), sink); ++k) {
  }
}

// The last tick that is due at `elapsed_ns`, at least `k`.
std::uint64_t last_due(std::uint64_t k, std::int64_t elapsed_ns, double rate_Hz) noexcept {
  auto due = static_cast<std::uint64_t>(static_cast<double>(elapsed_ns) * 1e-9 * rate_Hz);
  while (due_ns(due + 1, rate_Hz) <= elapsed_ns) ++due;
  while (due > 0 && due_ns(due, rate_Hz) > elapsed_ns) --due;
  return std::max(k, due);
}

// The servo thread. What was missed is skipped: the tick that runs late is the last one that is due.
void run_schedule(ServoCore& core, const ServoConfig& config, const std::atomic<bool>& stop,
                  const std::atomic<bool>& abandon, TickSink& sink, BootClock boot_now) {
  const std::int64_t start_ns = host_now_ns() + kLead_ns;
  const auto spin_ns = static_cast<std::int64_t>(config.spin_s * 1e9);
  SuspendWatch suspends;
  std::uint64_t done = 0;  // ticks of the schedule that are past
  for (std::uint64_t last = 0;;) {
    const std::int64_t expected_ns = start_ns + due_ns(done, config.rate_Hz);
    const std::int64_t begin_ns = wait_until(expected_ns, spin_ns);
    const std::uint64_t k = last_due(done, begin_ns - start_ns, config.rate_Hz);
    core.count_skipped(k - done);
    const std::uint64_t since = done == 0 ? 1 : k - last;
    const bool stop_asked = stop.load(std::memory_order_relaxed) || abandon.load(std::memory_order_relaxed);
    const bool suspended = was_suspended(suspends, boot_now(), host_now_ns(), config.reflexes.most_suspended_s);
    if (!core.tick(k, since, begin_ns - expected_ns, stop_asked, sink, suspended)) return;
    last = k;
    done = k + 1;
    if (host_now_ns() > start_ns + due_ns(done, config.rate_Hz)) core.count_overrun();
  }
}

void run_paced(ServoCore& core, const ServoConfig& config, const std::atomic<bool>& stop,
               const std::function<void(const ServoTick&)>& on_tick, BootClock boot_now) {
  QueueSink sink(static_cast<std::size_t>(kQueue_s * config.rate_Hz));
  std::atomic<bool> abandon{false};
  std::atomic<bool> done{false};
  std::string refused;
  std::thread servo([&] {
    // Here, so that the queue and this thread's stack are locked too where later memory cannot be.
    const MemoryLock memory(config.priority != RealTimePriority::kIgnore);
    core.set_memory_lock(memory.held(), memory.error());
    take_precise_timers();
    const bool granted = config.priority != RealTimePriority::kIgnore && take_real_time_priority(refused);
    core.set_real_time(granted);
    if (granted || config.priority != RealTimePriority::kEnforce)
      run_schedule(core, config, stop, abandon, sink, boot_now);
    done.store(true, std::memory_order_release);
  });
  std::exception_ptr failure;
  const auto drain = [&] {
    ServoTick tick;
    while (sink.queue().pop(tick)) {
      if (on_tick && !failure) on_tick(tick);
    }
  };
  const auto guarded_drain = [&] {
    try {
      drain();
    } catch (...) {
      failure = std::current_exception();
      abandon = true;
    }
  };
  while (!done.load(std::memory_order_acquire)) {
    guarded_drain();
    std::this_thread::sleep_for(kDrainEvery);
  }
  servo.join();
  guarded_drain();
  if (failure) std::rethrow_exception(failure);
  if (!refused.empty() && config.priority == RealTimePriority::kEnforce) {
    throw Error("real-time priority is enforced but not granted: " + refused);
  }
}

}  // namespace

ServoResult run_servo(HapticDevice& device, SnapshotExchange<const RenderModel>& scene, const ServoConfig& config,
                      const std::atomic<bool>& stop, const std::function<void(const ServoTick&)>& on_tick,
                      ServoStep step, const ForcePermit* permit) {
  return run_servo_on(&boot_now_ns, device, scene, config, stop, on_tick, step, permit);
}

ServoResult run_servo_on(BootClock boot_now, HapticDevice& device, SnapshotExchange<const RenderModel>& scene,
                         const ServoConfig& config, const std::atomic<bool>& stop,
                         const std::function<void(const ServoTick&)>& on_tick, ServoStep step,
                         const ForcePermit* permit) {
  const ForceGuard guard(device);
  check_servo_config(config);
  ServoCore core(device, scene, config, step, permit);
  if (config.paced) {
    run_paced(core, config, stop, on_tick, boot_now);
  } else {
    run_unpaced(core, stop, on_tick);
  }
  return core.take_result();
}

}  // namespace asperity
