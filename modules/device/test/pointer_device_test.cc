#include "asperity/device/pointer_device.h"

#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/testkit/count_allocations.h"

namespace asperity {

namespace {

constexpr std::int64_t kTick_ns = 1'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Pointer {
  explicit Pointer(const PointerDeviceConfig& config = {}, const Eigen::Vector3d& start_m = Eigen::Vector3d::Zero())
      : device(open_pointer(config, start_m, targets)) {}

  // Reads with the target renewed, and writes `force_N`.
  DeviceReading tick(const Eigen::Vector3d& target_m, const Eigen::Vector3d& force_N = Eigen::Vector3d::Zero()) {
    targets->publish(target_m);
    return rest(force_N);
  }
  DeviceReading rest(const Eigen::Vector3d& force_N = Eigen::Vector3d::Zero()) {
    const DeviceReading reading = device->read(t_ns);
    device->write(force_N);
    t_ns += kTick_ns;
    return reading;
  }

  std::shared_ptr<PointerTargets> targets = std::make_shared<PointerTargets>(Eigen::Vector3d::Zero());
  std::unique_ptr<HapticDevice> device;
  std::int64_t t_ns = 0;
};

}  // namespace

TEST(PointerDevice, StaysWhereItBeganUntilThePointerComes) {
  const Eigen::Vector3d start_m(0.1, 0.2, -0.3);
  Pointer pointer({}, start_m);
  for (int k = 0; k < 200; ++k) {
    const DeviceReading reading = pointer.rest();
    EXPECT_EQ(reading.p_m, start_m);
    EXPECT_EQ(reading.v_mps, Eigen::Vector3d::Zero());
  }
}

TEST(PointerDevice, ComesToThePointerAndStretchesItsSpringUnderAForce) {
  Pointer pointer;
  const Eigen::Vector3d target_m(0.01, -0.005, 0.002), force_N(0.0, 0.6, -0.3);
  DeviceReading reading;
  for (int k = 0; k < 2000; ++k) reading = pointer.tick(target_m, force_N);
  EXPECT_LT((reading.p_m - target_m - force_N / PointerDeviceConfig().stiffness_N_per_m).norm(), 1e-12);
  EXPECT_LT(reading.v_mps.norm(), 1e-12);
}

// The oracle: the same equations by Euler steps of 10 µs, whose own error is 1e-3 of the way.
TEST(PointerDevice, MovesAsItsEquationsSay) {
  const PointerDeviceConfig config;
  Pointer pointer(config);
  const double target_m = 0.02, force_N = -1.5;
  double p_m = 0.0, v_mps = 0.0, g_m = 0.0;
  for (int k = 0; k < 300; ++k) {
    const DeviceReading reading = pointer.tick({target_m, 0.0, 0.0}, {force_N, 0.0, 0.0});
    ASSERT_NEAR(reading.p_m.x(), p_m, 3e-5) << k;
    for (int i = 0; i < 100; ++i) {
      constexpr double kStep_s = 1e-5;
      const double a = (config.stiffness_N_per_m * (g_m - p_m) - config.damping_N_s_per_m * v_mps + force_N);
      p_m += kStep_s * v_mps;
      v_mps += kStep_s * a / config.mass_kg;
      g_m += kStep_s * (target_m - g_m) / config.smoothing_s;
    }
  }
}

TEST(PointerDevice, ItsPullHasALimit) {
  const PointerDeviceConfig config;
  Pointer pointer(config);
  const double most_N = config.stiffness_N_per_m * config.reach_m;
  // A pointer a kilometre away moves it no faster than that force does.
  double last_mps = 0.0;
  for (int k = 0; k < 500; ++k) {
    const DeviceReading reading = pointer.tick({0.0, 0.0, 1e3});
    EXPECT_LE(std::abs(reading.v_mps.z() - last_mps), most_N / config.mass_kg * 1e-3 * (1.0 + 1e-9));
    EXPECT_LE(reading.v_mps.z(), most_N / config.damping_N_s_per_m);
    last_mps = reading.v_mps.z();
  }
  // And a force as large as that holds it.
  Pointer held(config);
  DeviceReading reading;
  for (int k = 0; k < 3000; ++k) reading = held.tick({0.0, 0.0, 1e3}, {0.0, 0.0, -most_N});
  EXPECT_NEAR(reading.v_mps.z(), 0.0, 1e-9);
}

TEST(PointerDevice, StallsWithoutNewsAndComesBack) {
  PointerDeviceConfig config;
  config.stalled_after_s = 0.1;
  Pointer pointer(config);
  EXPECT_EQ(pointer.tick({0.0, 0.0, 0.01}).status, DeviceStatus::kReady);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(pointer.rest().status, DeviceStatus::kReady) << k;
  for (int k = 0; k < 50; ++k) EXPECT_EQ(pointer.rest().status, DeviceStatus::kStalled) << k;
  // What is no place is no news.
  EXPECT_EQ(pointer.tick({0.0, kNan, 0.01}).status, DeviceStatus::kStalled);
  EXPECT_TRUE(pointer.rest().p_m.allFinite());
  EXPECT_EQ(pointer.tick({0.0, 0.0, 0.01}).status, DeviceStatus::kReady);
}

TEST(PointerDevice, ServesTheSameTwice) {
  const auto run = [] {
    Pointer pointer;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3000; ++k) {
      const double t_s = 1e-3 * k;
      const Eigen::Vector3d force_N(0.1 * std::sin(40.0 * t_s), 0.0, std::max(0.0, -500.0 * sum.z()));
      const DeviceReading reading =
          k % 16 == 0 ? pointer.tick({0.01 * std::sin(t_s), 0.0, -0.002}, force_N) : pointer.rest(force_N);
      sum = 0.5 * sum + reading.p_m + reading.v_mps;
    }
    return sum;
  };
  EXPECT_EQ(run(), run());
}

// A power of two away from the origin is exact: the motion is the same there, but for the rounding of the place.
TEST(PointerDevice, MovesAlikeFarFromTheOrigin) {
  const Eigen::Vector3d far_m(1024.0, -1024.0, 0.0);
  Pointer here, there({}, far_m);
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d target_m(0.015625, 0.0078125, 0.0);
    const Eigen::Vector3d p_m = here.tick(target_m).p_m;
    EXPECT_LT((there.tick(target_m + far_m).p_m - far_m - p_m).norm(), 1e-10);
  }
}

TEST(PointerDevice, TicksDoNotAllocate) {
  Pointer pointer;
  const std::size_t before = testkit::count_allocations();
  for (int k = 0; k < 5000; ++k) pointer.tick({1e-5 * k, 0.0, 0.0}, {0.0, 0.0, 1.0});
  EXPECT_EQ(testkit::count_allocations(), before);
}

TEST(PointerDevice, RefusesWhatItCannotServe) {
  const auto targets = std::make_shared<PointerTargets>(Eigen::Vector3d::Zero());
  PointerDeviceConfig config;
  config.mass_kg = 0.0;
  EXPECT_THROW(open_pointer(config, Eigen::Vector3d::Zero(), targets), Error);
  EXPECT_THROW(open_pointer({}, Eigen::Vector3d(0.0, kNan, 0.0), targets), Error);
  EXPECT_THROW(open_pointer({}, Eigen::Vector3d::Zero(), nullptr), Error);
}

}  // namespace asperity
