#include "asperity/device/pointer_device.h"
#include "conformance.h"

namespace asperity::testing_devices {

namespace {

// A pointer far below, whose spring is at its reach: it pulls with 1 N whatever the point does.
class PointerRig final : public DeviceRig {
 public:
  std::unique_ptr<HapticDevice> open() override {
    PointerDeviceConfig config;
    config.mass_kg = 0.2;
    config.damping_N_s_per_m = 40.0;
    config.stiffness_N_per_m = 100.0;
    config.reach_m = kPull_N / config.stiffness_N_per_m;
    auto targets = std::make_shared<PointerTargets>(Eigen::Vector3d::Zero());
    return std::make_unique<Moved>(open_pointer(config, Eigen::Vector3d::Zero(), targets), targets, *this);
  }
  Eigen::Vector3d motor_output() override { return output_N_; }
  bool exclusive() const override { return false; }
  bool real_time() const override { return false; }
  bool can_unplug() const override { return false; }
  void stall() override { stalled_ = true; }

 private:
  // Publishes the pointer before each reading, and keeps what the device was given while it was open.
  class Moved final : public HapticDevice {
   public:
    Moved(std::unique_ptr<HapticDevice> inner, std::shared_ptr<PointerTargets> targets, PointerRig& rig)
        : inner_(std::move(inner)), targets_(std::move(targets)), rig_(rig) {}
    ~Moved() override { rig_.output_N_.setZero(); }
    const DeviceInfo& info() const noexcept override { return inner_->info(); }
    DeviceReading read(std::int64_t t_ns) noexcept override {
      if (!rig_.stalled_) targets_->publish({0.0, -10.0, 0.0});
      return inner_->read(t_ns);
    }
    void write(const Eigen::Vector3d& force_N) noexcept override {
      inner_->write(force_N);
      rig_.output_N_.setZero();
      if (!closed_ && force_N.allFinite()) rig_.output_N_ = force_N;
    }
    void close() noexcept override {
      closed_ = true;
      inner_->close();
      rig_.output_N_.setZero();
    }
    std::string fault() const override { return inner_->fault(); }

   private:
    std::unique_ptr<HapticDevice> inner_;
    std::shared_ptr<PointerTargets> targets_;
    PointerRig& rig_;
    bool closed_ = false;
  };

  Eigen::Vector3d output_N_ = Eigen::Vector3d::Zero();
  bool stalled_ = false;
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Pointer, DeviceConformance,
                         testing::Values(ConformanceCase{"mouse", [] { return std::make_unique<PointerRig>(); }}),
                         case_name);

}  // namespace asperity::testing_devices
