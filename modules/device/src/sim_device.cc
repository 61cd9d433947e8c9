#include "asperity/device/sim_device.h"

#include <utility>

#include "check_config.h"
#include "computed_device.h"
#include "simulated_hand.h"

namespace asperity {

namespace {

class SimDevice final : public ComputedDevice {
 public:
  SimDevice(const SimDeviceConfig& config, HandPath path)
      : ComputedDevice(config), hand_(config.hand, std::move(path)) {
    info_.name = "sim";
    info_.model = "computed hand";
    info_.bandwidth_Hz = config.bandwidth_Hz;
    info_.workspace_min_m.setConstant(-1.0);
    info_.workspace_max_m.setConstant(1.0);
  }

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

 private:
  SimulatedHand hand_;
  std::int64_t newest_ns_ = -1;
  std::uint64_t sequence_ = 0;
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
