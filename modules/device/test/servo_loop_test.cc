#include "asperity/device/servo_loop.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/device/safety_cause.h"
#include "asperity/testkit/count_allocations.h"
#include "fake_device.h"

namespace asperity {
namespace {

// A wall z < 0 of the config's stiffness.
ServoOutput wall_step(const RenderModel& model, ServoState& /*state*/, const DeviceState& device) noexcept {
  ServoOutput output;
  output.contact_N.z() = model.config.stiffness_N_per_m * std::max(-device.p_world_m.z(), 0.0);
  output.force_N = output.contact_N;
  return output;
}

std::unique_ptr<const RenderModel> wall(double stiffness_N_per_m) {
  auto model = std::make_unique<RenderModel>();
  model->config.stiffness_N_per_m = stiffness_N_per_m;
  return model;
}

struct Recorded {
  ServoResult result;
  std::vector<ServoTick> ticks;
};

Recorded run(FakeDevice& device, const ServoConfig& config) {
  SnapshotExchange<const RenderModel> scene(wall(1000.0));
  const std::atomic<bool> stop{false};
  Recorded all;
  all.result = run_servo(
      device, scene, config, stop, [&](const ServoTick& t) { all.ticks.push_back(t); }, wall_step);
  return all;
}

ServoConfig unpaced(double duration_s) {
  ServoConfig config;
  config.paced = false;
  config.duration_s = duration_s;
  return config;
}

TEST(ServoLoop, RunsItsDurationAndRampsDown) {
  FakeDevice device;
  device.path = [](std::uint64_t) { return Eigen::Vector3d(0.0, 0.0, -1e-3); };
  const Recorded r = run(device, unpaced(1.0));
  EXPECT_EQ(r.result.end, ServoEnd::kDuration);
  // 1000 ticks, then 20 of the ramp over 20 ms.
  ASSERT_EQ(r.ticks.size(), 1020U);
  EXPECT_EQ(r.result.statistics.ticks, 1020U);
  EXPECT_EQ(r.ticks[999].limited_by, 0U);
  EXPECT_DOUBLE_EQ(r.ticks[999].out_world_N.z(), 1.0);
  EXPECT_NEAR(r.ticks[1009].out_world_N.z(), 0.5, 1e-9);
  EXPECT_EQ(r.ticks[1009].limited_by, flag(SafetyCause::kEnding));
  EXPECT_EQ(r.ticks.back().out_world_N, Eigen::Vector3d::Zero());
  EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
  for (std::size_t k = 0; k < r.ticks.size(); ++k) ASSERT_EQ(r.ticks[k].t_ns, static_cast<std::int64_t>(k) * 1'000'000);
}

TEST(ServoLoop, PacedKeepsOrderAndZeroesTheForce) {
  FakeDevice device;
  device.path = [](std::uint64_t) { return Eigen::Vector3d(0.0, 0.0, -1e-3); };
  ServoConfig config;
  config.duration_s = 0.3;
  config.timed = true;
  const Recorded r = run(device, config);
  EXPECT_EQ(r.result.end, ServoEnd::kDuration);
  ASSERT_FALSE(r.ticks.empty());
  EXPECT_EQ(r.ticks.size() + r.result.statistics.lost_ticks, r.result.statistics.ticks);
  for (std::size_t k = 1; k < r.ticks.size(); ++k) ASSERT_GT(r.ticks[k].t_ns, r.ticks[k - 1].t_ns);
  EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
}

TEST(ServoLoop, AllocatesNothingPerTick) {
  SnapshotExchange<const RenderModel> scene(wall(1000.0));
  const std::atomic<bool> stop{false};
  const auto allocations_of = [&](double duration_s) {
    FakeDevice device;
    device.path = [](std::uint64_t k) {
      return Eigen::Vector3d(0.0, 0.0, 1e-3 * std::sin(0.01 * static_cast<double>(k)));
    };
    const std::size_t before = testkit::count_allocations();
    const ServoResult result = run_servo(device, scene, unpaced(duration_s), stop, nullptr, wall_step);
    const std::size_t after = testkit::count_allocations();
    EXPECT_GE(result.statistics.ticks, static_cast<std::uint64_t>(duration_s * 1000.0));
    return after - before;
  };
  EXPECT_EQ(allocations_of(1000.0), allocations_of(10.0));
}

}  // namespace
}  // namespace asperity
