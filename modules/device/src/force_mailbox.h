#pragma once

#include <chrono>
#include <cstdint>

#include <Eigen/Core>

#include "asperity/device/latest_value.h"

namespace asperity {

// The servo's force on its way to a thread that sends it, where it does not outlive its time.
class ForceMailbox {
 public:
  using Clock = std::chrono::steady_clock;

  // The servo thread alone. A force that is no number is none. Realtime-safe: yes.
  void publish(const Eigen::Vector3d& force_N) noexcept {
    orders_.publish({force_N.allFinite() ? force_N : Eigen::Vector3d::Zero(), ++published_});
  }

  // The sending thread alone: the newest force; zero if the servo has not renewed it for `timeout`.
  Eigen::Vector3d take(Clock::time_point now, Clock::duration timeout) noexcept {
    const Order& order = orders_.take();
    if (order.number != taken_) taken_at_ = now;
    taken_ = order.number;
    return taken_ > 0 && now - taken_at_ <= timeout ? order.force_N : Eigen::Vector3d::Zero();
  }

 private:
  struct Order {
    Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
    std::uint64_t number = 0;
  };
  LatestValue<Order> orders_;
  std::uint64_t published_ = 0;  // the servo's
  std::uint64_t taken_ = 0;      // the sender's
  Clock::time_point taken_at_{};
};

}  // namespace asperity
