#pragma once

#include <string>

#include "asperity/device/haptic_device.h"

namespace asperity {

// A device whose hand is computed: it takes a force up to its largest, and none once it is closed.
class ComputedDevice : public HapticDevice {
 public:
  const DeviceInfo& info() const noexcept override { return info_; }

  void write(const Eigen::Vector3d& force_N) noexcept override {
    force_N_.setZero();
    if (closed_ || !force_N.allFinite()) return;
    const double magnitude_N = force_N.stableNorm();
    force_N_ = magnitude_N > info_.max_force_N ? Eigen::Vector3d(force_N * (info_.max_force_N / magnitude_N)) : force_N;
  }

  void close() noexcept override {
    closed_ = true;
    force_N_.setZero();
  }

  std::string fault() const override { return {}; }

 protected:
  // With what every configuration of such a device says.
  template <class Config>
  explicit ComputedDevice(const Config& config) {
    info_.max_force_N = config.max_force_N;
    info_.max_continuous_force_N = config.max_force_N;
    info_.max_stiffness_N_per_m = config.max_stiffness_N_per_m;
    info_.rate_Hz = config.rate_Hz;
    info_.simulated = true;
  }

  DeviceInfo info_;
  Eigen::Vector3d force_N_ = Eigen::Vector3d::Zero();
  bool closed_ = false;
};

}  // namespace asperity
