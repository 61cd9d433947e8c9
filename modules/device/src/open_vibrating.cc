#include "asperity/device/open_vibrating.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kSlow_s = 0.05;       // of the directions: below what is heard
constexpr double kSlowest_mps = 1e-3;  // below this speed the direction of motion counts for less

// The vibration in a force as one number, linear in it: the part along the contact's slow direction and the part along
// the motion. The length of the force would be a rectifier: what trembles across it would be lost.
class OneAxis {
 public:
  double push(const Eigen::Vector3d& force_N, const Eigen::Vector3d& v_mps, std::int64_t t_ns) noexcept {
    const double dt_s = std::clamp(1e-9 * static_cast<double>(t_ns - last_ns_), 0.0, kSlow_s);
    last_ns_ = t_ns;
    if (!force_N.allFinite() || !v_mps.allFinite()) return 0.0;
    force_N_ += dt_s / kSlow_s * (force_N - force_N_);
    v_mps_ += dt_s / kSlow_s * (v_mps - v_mps_);
    const double length_N = force_N_.norm();
    const Eigen::Vector3d contact = length_N > 0.0 ? Eigen::Vector3d(force_N_ / length_N) : Eigen::Vector3d::Zero();
    const Eigen::Vector3d across_mps = v_mps_ - contact * contact.dot(v_mps_);
    return force_N.dot(contact + across_mps / (across_mps.norm() + kSlowest_mps));
  }

 private:
  Eigen::Vector3d force_N_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_mps_ = Eigen::Vector3d::Zero();
  std::int64_t last_ns_ = 0;
};

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
  OneAxis axis_;
  std::int64_t t_ns_ = 0;
  Eigen::Vector3d v_mps_ = Eigen::Vector3d::Zero();
};

}  // namespace

std::unique_ptr<HapticDevice> open_vibrating(std::unique_ptr<HapticDevice> hand, std::unique_ptr<VibrationSink> sink) {
  if (!hand || !sink) throw Error(hand ? "vibrating device: no sink" : "vibrating device: no hand");
  return std::make_unique<VibratingDevice>(std::move(hand), std::move(sink));
}

}  // namespace asperity
