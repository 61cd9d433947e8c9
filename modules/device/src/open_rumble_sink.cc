#include "asperity/device/open_rumble_sink.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/rumble_bands.h"
#include "check_config.h"
#include "sdl_functions.h"
#include "sdl_subsystem.h"
#include "soft_limit.h"
#include "spsc_queue.h"

namespace asperity {

namespace {

constexpr Uint32 kRumble_ms = 200;

class RumbleSink final : public VibrationSink {
 public:
  explicit RumbleSink(const RumbleSinkConfig& config)
      : config_(config), sdl_(SDL_INIT_JOYSTICK), bands_(config.high_pass_Hz, config.split_Hz, config.servo_rate_Hz) {
    std::string seen;
    for (int i = 0; i < sdl().NumJoysticks() && pad_ == nullptr; ++i) {
      const char* name = sdl().JoystickNameForIndex(i);
      const std::string known = name == nullptr ? "" : name;
      seen += (seen.empty() ? "" : ", ") + printable(known);
      if (known.find(config.device) == std::string::npos) continue;
      SDL_Joystick* pad = sdl().JoystickOpen(i);
      if (pad == nullptr) continue;
      if (sdl().JoystickHasRumble(pad) == SDL_TRUE) {
        pad_ = pad;
        info_.model = printable(known);
      } else {
        sdl().JoystickClose(pad);
      }
    }
    if (pad_ == nullptr) {
      throw Error("gamepad: none" + (config.device.empty() ? "" : " named '" + printable(config.device) + "'") +
                  " that rumbles (found: " + (seen.empty() ? "none at all" : seen) + ")");
    }
    info_.name = "gamepad";
    thread_ = std::thread([this] { run(); });
  }

  RumbleSink(const RumbleSink&) = delete;
  RumbleSink& operator=(const RumbleSink&) = delete;
  ~RumbleSink() override {
    close();
    sdl().JoystickClose(pad_);
  }

  const VibrationInfo& info() const noexcept override { return info_; }
  void push(double force_N) noexcept override {
    if (std::isfinite(force_N)) queue_.push(force_N);
  }
  bool working() const noexcept override { return !gone_.load(std::memory_order_relaxed); }

  void close() noexcept override {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  std::string fault() const override { return working() ? "" : "gamepad: " + info_.model + " is gone"; }

 private:
  using Clock = std::chrono::steady_clock;

  void run() {
    const auto period =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / config_.update_rate_Hz));
    const auto stale_after =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(config_.stale_after_s));
    auto due = Clock::now(), last_force = due - stale_after;
    std::unique_lock lock(mutex_);
    while (!stop_) {
      lock.unlock();
      const auto now = Clock::now();
      if (listen(now - last_force > stale_after && ever_)) last_force = now;
      const bool stale = now - last_force > stale_after;
      sdl().JoystickUpdate();
      if (sdl().JoystickGetAttached(pad_) != SDL_TRUE) gone_.store(true, std::memory_order_relaxed);
      // Updates that brought no force leave the motors as they are until that is stale.
      if (stale) {
        drive({});
      } else if (last_force == now) {
        drive(bands_.take());
      }
      due = std::max(due + period, now);
      lock.lock();
      wake_.wait_until(lock, due, [this] { return stop_; });
    }
    drive({});
    sdl().TLSCleanup();  // what SDL keeps for a thread that it has not made
  }

  // Takes what was pushed; true if something was. After a gap nobody felt the step to the first force.
  bool listen(bool after_gap) noexcept {
    bool any = false;
    for (double force_N = 0.0; queue_.pop(force_N); any = ever_ = true) {
      if (after_gap && !any) bands_.start_at(force_N);
      bands_.add(force_N);
    }
    return any;
  }

  Uint16 strength(double amplitude_N) const noexcept {
    const double level = soft_limit(config_.volume * amplitude_N / config_.full_scale_N, config_.ceiling);
    return static_cast<Uint16>(std::floor(65535.0 * std::min(level, config_.ceiling)));
  }

  void drive(const RumbleBands::Amplitudes& amplitudes) noexcept {
    const Uint16 low = strength(amplitudes.slow_N), high = strength(amplitudes.fast_N);
    if (low == 0 && high == 0 && resting_) return;
    resting_ = low == 0 && high == 0;
    sdl().JoystickRumble(pad_, low, high, resting_ ? 0 : kRumble_ms);
  }

  RumbleSinkConfig config_;
  SdlSubsystem sdl_;
  SDL_Joystick* pad_ = nullptr;
  VibrationInfo info_;
  SpscQueue<double> queue_{4096};
  std::atomic<bool> gone_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;

  // Its thread's.
  RumbleBands bands_;
  bool ever_ = false, resting_ = true;
  std::thread thread_;
};

}  // namespace

std::unique_ptr<VibrationSink> open_rumble_sink(const RumbleSinkConfig& config) {
  check_config("gamepad", config);
  if (!(config.split_Hz < 0.5 * config.servo_rate_Hz)) {
    throw Error("gamepad.split_Hz " + number_text(config.split_Hz) + " is not below half of servo_rate_Hz");
  }
  return std::make_unique<RumbleSink>(config);
}

}  // namespace asperity
