#include "asperity/device/sim_device.h"
#include "conformance.h"

namespace asperity::testing_devices {

namespace {

// A hand without a spring, pulled by 1 N: m 0.2 kg, b 40 N s/m.
class SimRig final : public DeviceRig {
 public:
  std::unique_ptr<HapticDevice> open() override {
    SimDeviceConfig config;
    config.hand.press_mass_kg = 0.2;
    config.hand.press_stiffness_N_per_m = 0.0;
    config.hand.press_damping_N_s_per_m = 40.0;
    auto device =
        open_sim(config, {{0, Eigen::Vector3d::Zero(), kPull_N}, {100'000'000'000, Eigen::Vector3d::Zero(), kPull_N}});
    return std::make_unique<Tap>(std::move(device), output_N_);
  }
  Eigen::Vector3d motor_output() override { return output_N_; }
  bool exclusive() const override { return false; }
  bool real_time() const override { return false; }
  bool can_unplug() const override { return false; }
  bool can_stall() const override { return false; }

 private:
  // Its motors are inside: what they were given is what was written, while it was open.
  class Tap final : public HapticDevice {
   public:
    Tap(std::unique_ptr<HapticDevice> inner, Eigen::Vector3d& output_N)
        : inner_(std::move(inner)), output_N_(output_N) {}
    ~Tap() override { output_N_.setZero(); }
    const DeviceInfo& info() const noexcept override { return inner_->info(); }
    DeviceReading read(std::int64_t t_ns) noexcept override { return inner_->read(t_ns); }
    void write(const Eigen::Vector3d& force_N) noexcept override {
      inner_->write(force_N);
      output_N_.setZero();
      if (!closed_ && force_N.allFinite()) output_N_ = force_N;
    }
    void close() noexcept override {
      closed_ = true;
      inner_->close();
      output_N_.setZero();
    }
    std::string fault() const override { return inner_->fault(); }

   private:
    std::unique_ptr<HapticDevice> inner_;
    Eigen::Vector3d& output_N_;
    bool closed_ = false;
  };
  Eigen::Vector3d output_N_ = Eigen::Vector3d::Zero();
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Sim, DeviceConformance,
                         testing::Values(ConformanceCase{"sim", [] { return std::make_unique<SimRig>(); }}), case_name);

}  // namespace asperity::testing_devices
