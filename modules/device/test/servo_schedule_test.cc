#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "servo_rig.h"

namespace asperity {
namespace {

TEST(ServoSchedule, RefusesAConfigOutOfRange) {
  const auto refuses = [](auto change, const char* what) {
    FakeDevice device;
    ServoConfig config = unpaced(0.01);
    change(config);
    try {
      run(device, config);
      ADD_FAILURE() << what;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(what));
    }
    EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
  };
  refuses([](ServoConfig& c) { c.rate_Hz = 10'000.0; }, "rate_Hz");
  refuses([](ServoConfig& c) { c.rate_Hz = std::numeric_limits<double>::quiet_NaN(); }, "rate_Hz");
  refuses([](ServoConfig& c) { c.duration_s = -1.0; }, "duration_s");
  refuses([](ServoConfig& c) { c.safety.max_force_N = 1e6; }, "safety.max_force_N");
  refuses([](ServoConfig& c) { c.safety.ramp_down_s = -1.0; }, "safety.ramp_down_s");
  refuses([](ServoConfig& c) { c.frame.R_world_device.coeffs().setConstant(1.0); }, "R_world_device");
  refuses([](ServoConfig& c) { c.frame.translation_m.x() = std::numeric_limits<double>::infinity(); }, "translation_m");
}

TEST(ServoSchedule, PacedKeepsOrderAndZeroesTheForce) {
  FakeDevice device;
  device.path = pressed;
  ServoConfig config;
  config.duration_s = 0.3;
  config.timed = true;
  const Recorded r = run(device, config);
  EXPECT_EQ(r.result.end, ServoEnd::kDuration);
  ASSERT_FALSE(r.ticks.empty());
  EXPECT_EQ(r.ticks.size() + r.result.statistics.lost_ticks, r.result.statistics.ticks);
  // Every due time either had a tick or was skipped.
  const auto due = static_cast<std::uint64_t>(std::llround(1e-6 * static_cast<double>(r.ticks.back().t_ns))) + 1;
  EXPECT_EQ(r.result.statistics.ticks + r.result.statistics.skipped, due);
  for (std::size_t k = 1; k < r.ticks.size(); ++k) ASSERT_GT(r.ticks[k].t_ns, r.ticks[k - 1].t_ns);
  EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
}

// A device that holds the loop up for 5 ms once: the missed due times are skipped, not caught up with.
TEST(ServoSchedule, SkipsWhatItMissed) {
  FakeDevice device;
  device.meddle = [](std::uint64_t k, DeviceReading&) {
    if (k == 50) std::this_thread::sleep_for(std::chrono::microseconds(5300));
  };
  ServoConfig config;
  config.duration_s = 0.2;
  const Recorded r = run(device, config);
  EXPECT_GE(r.result.statistics.skipped, 4U);
  EXPECT_GE(r.result.statistics.overruns, 1U);
  EXPECT_GE(r.result.statistics.late_max_s, 4e-3);
  // dt follows: with 4 due times missed the next tick stands for five.
  const ServoTick* before = nullptr;
  std::int64_t longest_ns = 0;
  for (const ServoTick& t : r.ticks) {
    if (before) longest_ns = std::max(longest_ns, t.t_ns - before->t_ns);
    before = &t;
  }
  EXPECT_GE(longest_ns, 5'000'000);
}

}  // namespace
}  // namespace asperity
