#include "asperity/device/open_vibrating.h"

#include <cstdint>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/device/vibration_axis.h"

namespace asperity {

namespace {

class VibratingDevice final : public HapticDevice {
 public:
  VibratingDevice(std::unique_ptr<HapticDevice> hand, std::unique_ptr<VibrationSink> sink)
      : hand_(std::move(hand)), sink_(std::move(sink)), info_(hand_->info()) {
    info_.name = sink_->info().name;
    info_.model = sink_->info().model + ", " + hand_->info().name + " " + hand_->info().model;
  }

  const DeviceInfo& info() const noexcept override { return info_; }

  DeviceReading read(std::int64_t t_ns) noexcept override {
    DeviceReading reading = hand_->read(t_ns);
    t_ns_ = t_ns;
    v_mps_ = reading.v_mps;
    if (!sink_->working()) reading.status = DeviceStatus::kFault;
    return reading;
  }

  void write(const Eigen::Vector3d& force_N) noexcept override {
    hand_->write(force_N);
    sink_->push(axis_.push(force_N, v_mps_, t_ns_));
  }

  void close() noexcept override {
    hand_->close();
    sink_->close();
  }

  std::string fault() const override {
    const std::string of_hand = hand_->fault();
    return of_hand.empty() ? sink_->fault() : of_hand;
  }

 private:
  std::unique_ptr<HapticDevice> hand_;
  std::unique_ptr<VibrationSink> sink_;
  DeviceInfo info_;
  VibrationAxis axis_;
  std::int64_t t_ns_ = 0;
  Eigen::Vector3d v_mps_ = Eigen::Vector3d::Zero();
};

}  // namespace

std::unique_ptr<HapticDevice> open_vibrating(std::unique_ptr<HapticDevice> hand, std::unique_ptr<VibrationSink> sink) {
  if (!hand || !sink) throw Error(hand ? "vibrating device: no sink" : "vibrating device: no hand");
  return std::make_unique<VibratingDevice>(std::move(hand), std::move(sink));
}

}  // namespace asperity
