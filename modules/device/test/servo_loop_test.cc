#include "asperity/device/servo_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/device/safety_cause.h"
#include "asperity/device/write_flight_record.h"
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

// Presses with 1 N.
Eigen::Vector3d pressed(std::uint64_t /*read*/) { return {0.0, 0.0, -1e-3}; }

TEST(ServoLoop, RunsItsDurationAndRampsDown) {
  FakeDevice device;
  device.path = pressed;
  const Recorded r = run(device, unpaced(1.0));
  EXPECT_EQ(r.result.end, ServoEnd::kDuration);
  // 1000 ticks, then 20 of the ramp over 20 ms.
  ASSERT_EQ(r.ticks.size(), 1020U);
  EXPECT_EQ(r.result.statistics.ticks, 1020U);
  EXPECT_EQ(r.result.statistics.lost_ticks, 0U);
  EXPECT_EQ(r.ticks[999].limited_by, 0U);
  EXPECT_DOUBLE_EQ(r.ticks[999].out_world_N.z(), 1.0);
  EXPECT_NEAR(r.ticks[1009].out_world_N.z(), 0.5, 1e-9);
  EXPECT_EQ(r.ticks[1009].limited_by, flag(SafetyCause::kEnding));
  EXPECT_EQ(r.ticks.back().out_world_N, Eigen::Vector3d::Zero());
  EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
  // 499 ticks of the soft start and 20 of the ramp are not as rendered.
  EXPECT_NEAR(static_cast<double>(r.result.statistics.limited_ticks), 519.0, 1.0);
}

TEST(ServoLoop, TicksAreDueAtRoundedTimes) {
  FakeDevice device;
  ServoConfig config = unpaced(1.0);
  config.rate_Hz = 3000.0;
  const Recorded r = run(device, config);
  ASSERT_EQ(r.ticks.size(), 3060U);
  for (std::size_t k = 0; k < r.ticks.size(); ++k) {
    ASSERT_EQ(r.ticks[k].t_ns, std::llround(static_cast<double>(k) * 1e9 / 3000.0));
  }
}

TEST(ServoLoop, StopRampsDown) {
  FakeDevice device;
  device.path = pressed;
  SnapshotExchange<const RenderModel> scene(wall(1000.0));
  std::atomic<bool> stop{false};
  std::uint64_t ticks = 0;
  const ServoResult result = run_servo(
      device, scene, unpaced(0.0), stop, [&](const ServoTick&) { stop = ++ticks == 700; }, wall_step);
  EXPECT_EQ(result.end, ServoEnd::kStopped);
  EXPECT_EQ(ticks, 720U);
  EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
}

TEST(ServoLoop, EndsWithItsDevice) {
  FakeDevice device;
  device.path = pressed;
  device.meddle = [](std::uint64_t k, DeviceReading& r) {
    if (k == 800) r.status = DeviceStatus::kEnded;
  };
  const Recorded r = run(device, unpaced(0.0));
  EXPECT_EQ(r.result.end, ServoEnd::kDeviceEnded);
  EXPECT_EQ(r.ticks.size(), 800U);
  EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
}

TEST(ServoLoop, AFaultEndsItWithZeroForceAndARecord) {
  for (const bool paced : {false, true}) {
    FakeDevice device;
    device.path = pressed;
    device.meddle = [](std::uint64_t k, DeviceReading& r) {
      if (k == 100) r.status = DeviceStatus::kFault;
    };
    ServoConfig config = unpaced(0.0);
    config.paced = paced;
    config.safety.soft_start_s = 0.0;
    const Recorded r = run(device, config);
    EXPECT_EQ(r.result.end, ServoEnd::kFault);
    ASSERT_FALSE(r.ticks.empty());
    EXPECT_EQ(r.ticks.back().limited_by, flag(SafetyCause::kFault));
    EXPECT_EQ(r.ticks.back().out_world_N, Eigen::Vector3d::Zero());
    EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
    EXPECT_EQ(r.result.last_ticks.size(), 101U);
    EXPECT_EQ(r.result.last_ticks.back().limited_by, flag(SafetyCause::kFault));
  }
}

TEST(ServoLoop, RecordsTheLastTwoSeconds) {
  FakeDevice device;
  const Recorded r = run(device, unpaced(5.0));
  ASSERT_EQ(r.result.last_ticks.size(), 2000U);
  for (std::size_t k = 0; k < 2000; ++k) {
    ASSERT_EQ(r.result.last_ticks[k].t_ns, r.ticks[r.ticks.size() - 2000 + k].t_ns);
  }
}

TEST(ServoLoop, AStallRampsToZeroAndComesBackSoftly) {
  FakeDevice device;
  device.path = pressed;
  device.meddle = [](std::uint64_t k, DeviceReading& r) {
    if (k >= 600 && k < 700) r.sequence = 600;
  };
  const Recorded r = run(device, unpaced(2.0));
  EXPECT_DOUBLE_EQ(r.ticks[600 + 18].out_world_N.z(), 1.0);
  EXPECT_EQ(r.ticks[650].out_world_N.z(), 0.0);
  EXPECT_EQ(r.ticks[650].limited_by, flag(SafetyCause::kStale));
  EXPECT_NEAR(r.ticks[699 + 250].out_world_N.z(), 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(r.ticks[1500].out_world_N.z(), 1.0);
}

TEST(ServoLoop, NeitherNanNorJumpsReachTheRendererOrTheHand) {
  FakeDevice device;
  device.path = [](std::uint64_t k) { return Eigen::Vector3d(0.0, 0.0, k % 97 == 0 ? -0.5 : 1e-3); };  // 500 N
  device.meddle = [](std::uint64_t k, DeviceReading& r) {
    if (k % 50 == 7) r.p_m.x() = std::numeric_limits<double>::quiet_NaN();
    if (k % 50 == 9) r.v_mps.setConstant(std::numeric_limits<double>::infinity());
  };
  const Recorded r = run(device, unpaced(3.0));
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (const ServoTick& t : r.ticks) {
    ASSERT_TRUE(t.out_world_N.allFinite());
    ASSERT_LE(t.out_world_N.norm(), 5.0 + 1e-12);
    ASSERT_LE((t.out_world_N - last).norm(), 2.0 + 1e-9);
    ASSERT_TRUE(t.output.force_N.allFinite());
    last = t.out_world_N;
  }
}

TEST(ServoLoop, EstimatesTheVelocityThatADeviceDoesNotGive) {
  FakeDevice device;
  device.path = [](std::uint64_t k) { return Eigen::Vector3d(1e-4 * static_cast<double>(k), 0.0, 0.0); };
  device.meddle = [](std::uint64_t, DeviceReading& r) {
    r.v_mps.setConstant(std::numeric_limits<double>::quiet_NaN());
    r.buttons = 5;
  };
  SnapshotExchange<const RenderModel> scene(wall(0.0));
  const std::atomic<bool> stop{false};
  ServoConfig config = unpaced(0.5);
  config.frame.scale = 10.0;
  Eigen::Vector3d v_mps = Eigen::Vector3d::Zero();
  std::uint32_t buttons = 0;
  run_servo(
      device, scene, config, stop,
      [&](const ServoTick& t) {
        v_mps = t.output.texture_N;
        buttons = t.reading.buttons;
      },
      [](const RenderModel&, ServoState&, const DeviceState& state) noexcept {
        ServoOutput output;
        output.texture_N = state.v_world_mps;  // to be seen
        return output;
      });
  EXPECT_NEAR(v_mps.x(), 1.0, 1e-9);  // 0.1 m/s of the hand, ten times as large
  EXPECT_EQ(buttons, 5U);
}

TEST(ServoLoop, TurnsForcesIntoTheDevicesAxes) {
  FakeDevice device;
  device.path = [](std::uint64_t) { return Eigen::Vector3d(0.0, -1e-3, 0.0); };
  ServoConfig config = unpaced(1.0);
  config.frame.R_world_device = Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * EIGEN_PI, Eigen::Vector3d::UnitX()));
  config.frame.scale = 2.0;
  Eigen::Vector3d written = Eigen::Vector3d::Zero();
  SnapshotExchange<const RenderModel> scene(wall(1000.0));
  const std::atomic<bool> stop{false};
  run_servo(
      device, scene, config, stop,
      [&](const ServoTick& t) {
        if (t.t_ns == 900'000'000) written = device.force_N;
      },
      wall_step);
  // The device's y is the scene's z: 1 mm up to 2 mm inside, 2 N back along y.
  EXPECT_LT((written - Eigen::Vector3d(0.0, 2.0, 0.0)).norm(), 1e-12);
}

TEST(ServoLoop, TakesNewScenesWhileItRuns) {
  for (const bool paced : {false, true}) {
    FakeDevice device;
    device.path = pressed;
    SnapshotExchange<const RenderModel> scene(wall(1000.0));
    const std::atomic<bool> stop{false};
    ServoConfig config = unpaced(0.3);
    config.paced = paced;
    int published = 0;
    double last_N = 0.0;
    run_servo(
        device, scene, config, stop,
        [&](const ServoTick& t) {
          if (t.t_ns / 50'000'000 > published) scene.publish(wall(1000.0 + 100.0 * ++published));
          last_N = t.output.force_N.z();
        },
        wall_step);
    EXPECT_GT(published, 3);
    EXPECT_GT(last_N, 1.0 + 1e-9);
    if (!paced) {
      EXPECT_NEAR(last_N, 1.0 + 0.1 * published, 1e-9);
    }
  }
}

TEST(ServoLoop, AnExceptionOfTheListenerStopsItWithZeroForce) {
  for (const bool paced : {false, true}) {
    FakeDevice device;
    device.path = pressed;
    SnapshotExchange<const RenderModel> scene(wall(1000.0));
    const std::atomic<bool> stop{false};
    ServoConfig config = unpaced(0.0);
    config.paced = paced;
    int ticks = 0;
    const auto listener = [&](const ServoTick&) {
      if (++ticks == 100) throw std::runtime_error("disk full");
    };
    EXPECT_THROW(run_servo(device, scene, config, stop, listener, wall_step), std::runtime_error);
    EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
  }
}

TEST(ServoLoop, RefusesAConfigOutOfRange) {
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

TEST(ServoLoop, PacedKeepsOrderAndZeroesTheForce) {
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
TEST(ServoLoop, SkipsWhatItMissed) {
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

std::string bytes_of(const Recorded& r) { return format_flight_record(r.ticks); }

TEST(ServoLoop, UnpacedIsDeterministic) {
  const auto once = [] {
    FakeDevice device;
    device.path = [](std::uint64_t k) {
      const double t = 1e-3 * static_cast<double>(k);
      return Eigen::Vector3d(0.01 * std::sin(3.0 * t), 0.0, 1e-3 * std::sin(17.0 * t));
    };
    return bytes_of(run(device, unpaced(2.0)));
  };
  const std::string first = once();
  EXPECT_GT(first.size(), 100'000U);
  EXPECT_TRUE(first == once());
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
