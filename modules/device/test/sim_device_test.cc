#include "asperity/device/sim_device.h"

#include <limits>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/testkit/count_allocations.h"

namespace asperity {

namespace {

constexpr double kWall_N_per_m = 2000.0;

Eigen::Vector3d wall_N(const DeviceReading& reading) {
  return {0.0, kWall_N_per_m * std::max(0.0, -reading.p_m.y()), 0.0};
}

}  // namespace

TEST(SimDevice, StrokesAtItsSpeedPressedWithItsForce) {
  SimDeviceConfig config;
  config.stroke.length_m = 0.03;
  config.stroke.speed_mps = 0.02;
  config.stroke.press_N = 1.0;
  const auto device = open_sim(config);
  EXPECT_TRUE(device->info().simulated);
  int steady = 0;
  DeviceReading reading;
  std::int64_t t_ns = 0;
  for (; t_ns < 10'000'000'000; t_ns += 1'000'000) {
    reading = device->read(t_ns);
    if (reading.status == DeviceStatus::kEnded) break;
    device->write(wall_N(reading));
    if (t_ns > 1'200'000'000 && t_ns < 2'100'000'000) {
      ++steady;
      EXPECT_NEAR(reading.v_mps.x(), 0.02, 1e-4);
      EXPECT_NEAR(reading.p_m.y(), -1.0 / kWall_N_per_m, 2e-6);
      EXPECT_EQ(reading.p_m.z(), 0.0);
    }
  }
  EXPECT_EQ(steady, 899);
  EXPECT_EQ(t_ns, 2'901'000'000);  // 0.2 + 0.5 + 1.5 + 0.5 + 0.2 s and a tick
  EXPECT_NEAR(reading.p_m.x(), 0.03, 1e-6);
}

TEST(SimDevice, ServesTheSameTwice) {
  const auto run = [] {
    const auto device = open_sim({});
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::int64_t t_ns = 0; t_ns < 3'000'000'000; t_ns += 250'000) {
      const DeviceReading reading = device->read(t_ns);
      device->write(wall_N(reading));
      sum = 0.5 * sum + reading.p_m + reading.v_mps;
    }
    return sum;
  };
  EXPECT_EQ(run(), run());
}

TEST(SimDevice, ItsMotorsHaveALimit) {
  SimDeviceConfig config;
  config.max_force_N = 2.0;
  const auto limited = open_sim(config);
  const auto exact = open_sim(config);
  const auto none = open_sim(config);
  const auto broken = open_sim(config);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [device, force_N] : {std::pair{limited.get(), Eigen::Vector3d(0, 30, 40)},
                                        {exact.get(), {0, 1.2, 1.6}},
                                        {none.get(), {0, 0, 0}},
                                        {broken.get(), {0, nan, 0}}}) {
    device->read(0);
    device->write(force_N);
  }
  const auto at = [](HapticDevice& device) { return device.read(10'000'000).p_m; };
  EXPECT_LT((at(*limited) - at(*exact)).norm(), 1e-15);
  EXPECT_EQ(at(*none), at(*broken));
  EXPECT_GT(at(*exact).y(), at(*none).y());
}

TEST(SimDevice, AReadingOfThePastIsTheLastOne) {
  const auto device = open_sim({});
  const DeviceReading first = device->read(800'000'000);
  const DeviceReading again = device->read(700'000'000);
  EXPECT_EQ(again.sequence, first.sequence);
  EXPECT_EQ(again.p_m, first.p_m);
}

TEST(SimDevice, TicksDoNotAllocate) {
  const auto device = open_sim({});
  const std::size_t before = testkit::count_allocations();
  for (std::int64_t t_ns = 0; t_ns < 4'000'000'000; t_ns += 1'000'000) device->write(wall_N(device->read(t_ns)));
  EXPECT_EQ(testkit::count_allocations(), before);
}

TEST(SimDevice, RefusesAConfigOutOfItsRanges) {
  SimDeviceConfig config;
  config.max_force_N = std::numeric_limits<double>::infinity();
  EXPECT_THROW(open_sim(config), Error);
  config = {};
  config.stroke.speed_mps = -1.0;
  EXPECT_THROW(open_sim(config), Error);
}

}  // namespace asperity
