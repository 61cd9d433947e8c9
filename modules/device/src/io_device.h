#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string>

#include <Eigen/Core>

#include "asperity/device/haptic_device.h"
#include "asperity/device/latest_value.h"
#include "real_time.h"
#include "stall_watch.h"

namespace asperity {

// The servo's force on its way to a thread that sends it, where it does not outlive its time.
class ForceMailbox {
 public:
  using Clock = std::chrono::steady_clock;

  // The servo thread alone. A force that is no number is none. Realtime-safe: yes.
  void publish(const Eigen::Vector3d& force_N) noexcept {
    forces_.publish(force_N.allFinite() ? force_N : Eigen::Vector3d::Zero());
  }

  // The sending thread alone: the newest force; zero if the servo has not renewed it for `timeout`.
  Eigen::Vector3d take(Clock::time_point now, Clock::duration timeout) noexcept {
    if (forces_.take_if_new(force_N_)) taken_at_ = now;
    return now - taken_at_ <= timeout ? force_N_ : Eigen::Vector3d::Zero();
  }

 private:
  LatestValue<Eigen::Vector3d> forces_{Eigen::Vector3d::Zero()};
  Eigen::Vector3d force_N_ = Eigen::Vector3d::Zero();
  Clock::time_point taken_at_{};
};

// A slow device, which has an I/O thread of its own: news goes one way, forces the other. Who derives from it has the
// thread, ends it in close(), and calls close() in its destructor.
class IoDevice : public HapticDevice {
 public:
  IoDevice(const IoDevice&) = delete;
  IoDevice& operator=(const IoDevice&) = delete;

  const DeviceInfo& info() const noexcept override { return info_; }

  DeviceReading read(std::int64_t t_ns) noexcept override {
    const News& news = news_.take();
    DeviceReading reading;
    reading.p_m = news.p_m;
    reading.v_mps = news.v_mps;
    reading.sequence = news.sequence;
    if (watch_.stalled(t_ns, news.sequence)) reading.status = DeviceStatus::kStalled;
    if (stop_.load(std::memory_order_relaxed)) reading.status = DeviceStatus::kEnded;
    if (faulty_.load(std::memory_order_acquire)) reading.status = DeviceStatus::kFault;
    return reading;
  }

  void write(const Eigen::Vector3d& force_N) noexcept override { forces_.publish(force_N); }

  std::string fault() const override {
    const std::lock_guard lock(fault_mutex_);
    return fault_;
  }

 protected:
  using Clock = ForceMailbox::Clock;

  // What the I/O thread tells the servo thread, in the device's axes.
  struct News {
    Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d v_mps = Eigen::Vector3d::Zero();
    std::uint64_t sequence = 0;
  };

  explicit IoDevice(double stall_after_s) : watch_(stall_after_s) {}

  static Clock::duration seconds(double s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
  }

  // The I/O thread's: `serve` until it returns; what it throws is the device's fault. Real-time priority is asked for,
  // as the servo thread does: a position that this thread is late with is as old as one that the device is late with.
  template <class Serve>
  void run(const Serve& serve) {
    try {
      std::string refused;
      take_real_time_priority(refused);
      take_precise_timers();
      serve();
    } catch (const std::exception& error) {
      const std::lock_guard lock(fault_mutex_);
      fault_ = error.what();
      faulty_.store(true, std::memory_order_release);
    }
  }

  DeviceInfo info_;
  LatestValue<News> news_;  // from the I/O thread
  ForceMailbox forces_;     // to it
  std::atomic<bool> stop_{false};

 private:
  StallWatch watch_;  // the servo thread's
  std::atomic<bool> faulty_{false};
  mutable std::mutex fault_mutex_;
  std::string fault_;
};

}  // namespace asperity
