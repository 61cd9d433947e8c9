#include "asperity/device/force_permit.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/device/pointer_device.h"
#include "asperity/device/safety_cause.h"
#include "asperity/testkit/count_allocations.h"
#include "servo_rig.h"

namespace asperity {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kNotPermitted = flag(SafetyCause::kNotPermitted);

// Presses a wall with 1 N for `ticks` of a millisecond; `meddle` is called after each, with its number.
std::vector<ServoTick> pressed_under(ForcePermit& permit, std::size_t ticks,
                                     const std::function<void(std::size_t)>& meddle) {
  FakeDevice device;
  device.path = pressed;
  SnapshotExchange<const RenderModel> scene(wall(1000.0));
  const std::atomic<bool> stop{false};
  std::vector<ServoTick> out;
  run_servo(
      device, scene, unpaced(1e-3 * static_cast<double>(ticks)), stop,
      [&](const ServoTick& tick) {
        out.push_back(tick);
        meddle(out.size() - 1);
      },
      wall_step, &permit);
  return out;
}

}  // namespace

TEST(ForcePermit, NothingIsPermittedAtFirst) {
  ForcePermit permit;
  for (const ServoTick& tick : pressed_under(permit, 700, [](std::size_t) {})) {
    EXPECT_EQ(tick.out_world_N, Eigen::Vector3d::Zero());
    EXPECT_NE(tick.limited_by & kNotPermitted, 0U);
    EXPECT_EQ(tick.output.force_N.z(), 1.0);  // it goes on being rendered, and shown
  }
}

TEST(ForcePermit, RevokingRampsToZeroAndGivingComesBackSoftly) {
  ForcePermit permit;
  permit.renew();
  const auto ticks = pressed_under(permit, 2000, [&](std::size_t k) {
    if (k < 799 || k >= 1099) permit.renew();
    if (k == 799) permit.revoke();
  });
  EXPECT_DOUBLE_EQ(ticks[799].out_world_N.z(), 1.0);
  EXPECT_EQ(ticks[799].limited_by, 0U);
  // ramp_down_s: 20 ticks of 5 %.
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_NEAR(ticks[800 + k].out_world_N.z(), 1.0 - 0.05 * static_cast<double>(k + 1), 1e-9);
    EXPECT_EQ(ticks[800 + k].limited_by, kNotPermitted);
    EXPECT_NEAR(ticks[800 + k].gain, 1.0 - 0.05 * static_cast<double>(k + 1), 1e-9);
  }
  for (std::size_t k = 820; k < 1100; ++k) EXPECT_EQ(ticks[k].out_world_N, Eigen::Vector3d::Zero());
  // soft_start_s: half after 250 ticks.
  EXPECT_EQ(ticks[1100].limited_by, flag(SafetyCause::kSoftStart));
  EXPECT_NEAR(ticks[1099 + 250].out_world_N.z(), 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(ticks[1700].out_world_N.z(), 1.0);
}

// Who gives it may hang: then nobody revokes it either.
TEST(ForcePermit, EndsByItselfIfItIsNotRenewed) {
  ForcePermit permit;
  permit.renew();
  const auto ticks = pressed_under(permit, 1500, [&](std::size_t k) {
    if (k < 800) permit.renew();
  });
  const auto lasts = static_cast<std::size_t>(1000.0 * ForcePermit::kLasts_s);
  EXPECT_EQ(ticks[800 + lasts - 1].limited_by, 0U);
  EXPECT_EQ(ticks[800 + lasts + 1].limited_by, kNotPermitted);
  EXPECT_EQ(ticks[800 + lasts + 22].out_world_N, Eigen::Vector3d::Zero());
}

TEST(ForcePermit, IsRenewedAtLeisure) {
  ForcePermit permit;
  permit.renew();
  const auto ticks = pressed_under(permit, 2000, [&](std::size_t k) {
    if (k % 200 == 0) permit.renew();
  });
  for (std::size_t k = 600; k < ticks.size() - 25; ++k) ASSERT_EQ(ticks[k].limited_by, 0U) << k;
}

TEST(ForcePermit, LowersTheLargestForceAndNeverRaisesIt) {
  ForcePermit permit;
  permit.renew();
  const auto ticks = pressed_under(permit, 1600, [&](std::size_t k) {
    permit.renew();
    if (k == 800) permit.limit(0.25);
    if (k == 1000) permit.limit(1e9);
    if (k == 1200) permit.limit(kNan);
  });
  EXPECT_DOUBLE_EQ(ticks[799].out_world_N.z(), 1.0);
  EXPECT_NEAR(ticks[900].out_world_N.z(), 0.25, 1e-12);
  EXPECT_EQ(ticks[900].limited_by, flag(SafetyCause::kForceLimit));
  EXPECT_DOUBLE_EQ(ticks[1100].out_world_N.z(), 1.0);
  EXPECT_EQ(ticks[1300].out_world_N, Eigen::Vector3d::Zero());
  const SafetyConfig config;
  for (std::size_t k = 1; k < ticks.size(); ++k) {
    ASSERT_LE((ticks[k].out_world_N - ticks[k - 1].out_world_N).norm(), config.max_force_rate_N_per_s * 1e-3 + 1e-12);
  }
}

// The whole loop of a pointer: its targets, the permit and the ramps.
TEST(ForcePermit, ALoopWithAPointerAllocatesNothingPerTick) {
  const auto allocations_of = [](std::size_t ticks) {
    const auto targets = std::make_shared<PointerTargets>(Eigen::Vector3d::Zero());
    const auto device = open_pointer({}, Eigen::Vector3d::Zero(), targets);
    SnapshotExchange<const RenderModel> scene(wall(1000.0));
    const std::atomic<bool> stop{false};
    ForcePermit permit;
    double largest_N = 0.0;
    std::size_t k = 0;
    const std::size_t before = testkit::count_allocations();
    run_servo(
        *device, scene, unpaced(1e-3 * static_cast<double>(ticks)), stop,
        [&](const ServoTick& tick) {
          largest_N = std::max(largest_N, tick.out_world_N.norm());
          if (++k % 16 == 0) targets->publish({0.0, 1e-3 * static_cast<double>(k % 7), -0.004});
          if (k % 3000 < 2000) permit.renew();
        },
        wall_step, &permit);
    EXPECT_GT(largest_N, 0.5);
    return testkit::count_allocations() - before;
  };
  EXPECT_EQ(allocations_of(200'000), allocations_of(5'000));
}

}  // namespace asperity
