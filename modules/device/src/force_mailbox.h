#pragma once

#include <chrono>

#include <Eigen/Core>

#include "asperity/device/latest_value.h"

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

}  // namespace asperity
