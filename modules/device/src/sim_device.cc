#include "asperity/device/sim_device.h"

#include <algorithm>
#include <utility>

#include "asperity/device/simulated_hand.h"
#include "check_config.h"

namespace asperity {

namespace {

class SimDevice final : public HapticDevice {
 public:
  SimDevice(const SimDeviceConfig& config, HandPath path) : hand_(config.hand, std::move(path)) {
    info_.name = "sim";
    info_.model = "computed hand";
    info_.max_force_N = config.max_force_N;
    info_.max_continuous_force_N = config.max_force_N;
    info_.max_stiffness_N_per_m = config.max_stiffness_N_per_m;
    info_.bandwidth_Hz = config.bandwidth_Hz;
    info_.rate_Hz = config.rate_Hz;
    info_.workspace_min_m.setConstant(-1.0);
    info_.workspace_max_m.setConstant(1.0);
    info_.simulated = true;
  }

  const DeviceInfo& info() const noexcept override { return info_; }

  DeviceReading read(std::int64_t t_ns) noexcept override {
    // The schedule's times are small beside kFarthest_ns: their sum with the start does not overflow.
    if (t_ns > newest_ns_) {
      newest_ns_ = t_ns;
      ++sequence_;
      hand_.advance(hand_.start_ns() + t_ns, force_N_);
    }
    DeviceReading reading;
    reading.p_m = hand_.p_m();
    reading.v_mps = hand_.v_mps();
    reading.sequence = sequence_;
    if (closed_ || newest_ns_ > hand_.end_ns() - hand_.start_ns()) reading.status = DeviceStatus::kEnded;
    return reading;
  }

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

 private:
  DeviceInfo info_;
  SimulatedHand hand_;
  Eigen::Vector3d force_N_ = Eigen::Vector3d::Zero();
  std::int64_t newest_ns_ = -1;
  std::uint64_t sequence_ = 0;
  bool closed_ = false;
};

}  // namespace

std::unique_ptr<HapticDevice> open_sim(const SimDeviceConfig& config, HandPath path) {
  check_config("sim", config);
  return std::make_unique<SimDevice>(config, std::move(path));
}

std::unique_ptr<HapticDevice> open_sim(const SimDeviceConfig& config) {
  return open_sim(config, make_stroke(config.stroke));
}

}  // namespace asperity
