#include "asperity/device/open_vibrating.h"

#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/device/sim_device.h"
#include "asperity/testkit/count_allocations.h"

namespace asperity {

namespace {

constexpr double kTone_Hz = 200.0;
constexpr int kTicks = 2000;

class RecordingSink final : public VibrationSink {
 public:
  explicit RecordingSink(std::vector<double>& heard_N) : heard_N_(heard_N) {}
  const VibrationInfo& info() const noexcept override { return info_; }
  void push(double force_N) noexcept override { heard_N_.push_back(force_N); }
  bool working() const noexcept override { return working_; }
  void close() noexcept override {}
  std::string fault() const override { return working_ ? "" : "pulled out"; }
  void pull_out() { working_ = false; }

 private:
  VibrationInfo info_{"test", "a list"};
  std::vector<double>& heard_N_;
  bool working_ = true;
};

// A hand that moves along x at 50 mm/s.
std::unique_ptr<HapticDevice> moving_hand() {
  return open_sim({}, {{0, Eigen::Vector3d::Zero(), 0.0}, {10'000'000'000, Eigen::Vector3d(0.5, 0.0, 0.0), 0.0}});
}

// Amplitude of the second half of what was heard at `f_Hz`, both at 1 kHz and whole periods long.
double amplitude(const std::vector<double>& heard, double f_Hz) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = heard.size() / 2; i < heard.size(); ++i) {
    sum += heard[i] * std::polar(1.0, -2.0 * std::numbers::pi * f_Hz * 1e-3 * static_cast<double>(i));
  }
  return 2.0 * std::abs(sum) / static_cast<double>(heard.size() - heard.size() / 2);
}

// What is heard of 1 N along z and a tone of 0.2 N along `axis`.
std::vector<double> heard_of(const Eigen::Vector3d& axis) {
  std::vector<double> heard;
  heard.reserve(kTicks);
  const auto device = open_vibrating(moving_hand(), std::make_unique<RecordingSink>(heard));
  const std::size_t before = testkit::count_allocations();
  for (int k = 0; k < kTicks; ++k) {
    device->read(static_cast<std::int64_t>(k) * 1'000'000);
    device->write(Eigen::Vector3d::UnitZ() + 0.2 * std::sin(2.0 * std::numbers::pi * kTone_Hz * 1e-3 * k) * axis);
  }
  EXPECT_EQ(testkit::count_allocations(), before);
  return heard;
}

}  // namespace

// The directions follow the force at 1/20 of a second, which moves some 1 % of a 200 Hz tone.
TEST(OpenVibrating, HearsAToneAlongTheContact) {
  const std::vector<double> heard = heard_of(Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(amplitude(heard, kTone_Hz), 0.2, 0.02 * 0.2);
}

TEST(OpenVibrating, HearsAToneAlongTheMotionAtItsOwnPitch) {
  const std::vector<double> heard = heard_of(Eigen::Vector3d::UnitX());
  EXPECT_NEAR(amplitude(heard, kTone_Hz), 0.2, 0.05 * 0.2);
  EXPECT_LT(amplitude(heard, 2.0 * kTone_Hz), 0.02 * 0.2);
}

TEST(OpenVibrating, ALostSinkIsAFault) {
  std::vector<double> heard;
  auto sink = std::make_unique<RecordingSink>(heard);
  RecordingSink& still_here = *sink;
  const auto device = open_vibrating(moving_hand(), std::move(sink));
  EXPECT_EQ(device->read(0).status, DeviceStatus::kReady);
  still_here.pull_out();
  EXPECT_EQ(device->read(1'000'000).status, DeviceStatus::kFault);
  EXPECT_EQ(device->fault(), "pulled out");
}

}  // namespace asperity
