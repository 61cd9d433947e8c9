#include <chrono>
#include <limits>
#include <thread>

#include "asperity/base/error.h"
#include "asperity/testkit/lateness_watch.h"
#include "conformance.h"
#include "serve_device.h"

namespace asperity::testing_devices {

namespace {

constexpr double kWall_N_per_m = 2000.0;
constexpr std::int64_t kTick_ns = 1'000'000;
constexpr double kPatience_s = 30.0;  // of ticks; a loaded machine only takes longer over them

Eigen::Vector3d no_force(const DeviceReading&) { return Eigen::Vector3d::Zero(); }
Eigen::Vector3d half_newton_up(const DeviceReading&) { return {0.0, 0.5, 0.0}; }

}  // namespace

DeviceReading DeviceConformance::tick(HapticDevice& device,
                                      const std::function<Eigen::Vector3d(const DeviceReading&)>& law) {
  DeviceReading reading = device.read(t_ns_);
  device.write(law(reading));
  t_ns_ += kTick_ns;
  if (rig_->real_time()) std::this_thread::sleep_for(std::chrono::nanoseconds(kTick_ns));
  return reading;
}

bool DeviceConformance::tick_until(HapticDevice& device, double limit_s,
                                   const std::function<Eigen::Vector3d(const DeviceReading&)>& law,
                                   const std::function<bool(const DeviceReading&)>& done) {
  const std::int64_t end_ns = t_ns_ + static_cast<std::int64_t>(limit_s * 1e9);
  while (t_ns_ < end_ns) {
    if (done(tick(device, law))) return true;
  }
  return false;
}

bool DeviceConformance::motors_become_silent() {
  return comes_true([this] { return rig_->motor_output() == Eigen::Vector3d::Zero(); });
}

TEST_P(DeviceConformance, OpensSaysWhatItIsAndStartsWithoutForce) {
  const auto device = rig_->open();
  ASSERT_NE(device, nullptr);
  EXPECT_FALSE(device->info().name.empty());
  EXPECT_GT(device->info().rate_Hz, 0.0);
  EXPECT_EQ(rig_->motor_output(), Eigen::Vector3d::Zero());
  EXPECT_EQ(device->fault(), "");
}

TEST_P(DeviceConformance, ReadsFinitePositionsWithRisingSequence) {
  const auto device = rig_->open();
  ASSERT_TRUE(tick_until(*device, kPatience_s, no_force, [](const DeviceReading& r) { return r.sequence > 0; }));
  std::uint64_t before = 0;
  int fresh = 0;
  EXPECT_TRUE(tick_until(*device, kPatience_s, no_force, [&](const DeviceReading& r) {
    EXPECT_TRUE(r.p_m.allFinite() && r.v_mps.allFinite());
    EXPECT_GE(r.sequence, before);
    fresh += r.sequence > before ? 1 : 0;
    before = r.sequence;
    return fresh >= 20;
  }));
}

TEST_P(DeviceConformance, RestsAtTheExpectedDepthOnAWall) {
  if (!rig_->has_position()) return;
  double y_m = 0.0;
  Eigen::Vector3d output = Eigen::Vector3d::Zero();
  // True if the hand rests there. A busy machine's answers come late, which is the device's fault in the end.
  const auto rests = [&] {
    rig_.reset();
    rig_ = GetParam().make();
    t_ns_ = 0;
    const auto device = rig_->open();
    DeviceReading first;
    if (!tick_until(*device, kPatience_s, no_force, [&](const DeviceReading& r) {
          first = r;
          return r.sequence > 0;
        }))
      return false;
    const double wall_y_m = first.p_m.y() - 2e-3;
    const auto wall = [&](const DeviceReading& r) {
      return Eigen::Vector3d(0.0, kWall_N_per_m * std::max(0.0, wall_y_m - r.p_m.y()), 0.0);
    };
    const double depth_m = DeviceRig::kPull_N / kWall_N_per_m;
    constexpr double kTolerance_m = 5e-6;  // 10 mN on that wall
    int resting = 0;
    tick_until(*device, kPatience_s, wall, [&](const DeviceReading& r) {
      y_m = r.p_m.y() - wall_y_m;
      resting = std::abs(y_m + depth_m) < kTolerance_m ? resting + 1 : 0;
      return resting >= 50 || r.status == DeviceStatus::kFault;
    });
    output = rig_->motor_output();
    return resting >= 50 && std::abs(output.y() - DeviceRig::kPull_N) < 0.02;
  };
  EXPECT_TRUE(testkit::holds_on_a_free_machine(rests))
      << "it is " << y_m * 1e3 << " mm above the wall's face, at " << output.y() << " N";
}

// A driver may ramp the first forces after its start.
TEST_P(DeviceConformance, DrivesItsMotorsAsWritten) {
  const auto device = rig_->open();
  EXPECT_TRUE(tick_until(*device, kPatience_s, half_newton_up, [&](const DeviceReading&) {
    const Eigen::Vector3d output = rig_->motor_output();
    return rig_->has_position() ? (output - Eigen::Vector3d(0.0, 0.5, 0.0)).norm() < 0.02 : output.norm() > 0.0;
  })) << rig_->motor_output();
}

TEST_P(DeviceConformance, ForceThatIsNoNumberIsNone) {
  const auto device = rig_->open();
  ASSERT_TRUE(tick_until(*device, kPatience_s, half_newton_up,
                         [&](const DeviceReading&) { return rig_->motor_output().norm() > 0.0; }));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto broken = [&](const DeviceReading&) { return Eigen::Vector3d(0.0, nan, 0.0); };
  EXPECT_TRUE(tick_until(*device, kPatience_s, broken,
                         [&](const DeviceReading&) { return rig_->motor_output() == Eigen::Vector3d::Zero(); }));
}

TEST_P(DeviceConformance, ClosesWithoutForceAndTakesNoneAfterwards) {
  const auto device = rig_->open();
  ASSERT_TRUE(tick_until(*device, kPatience_s, half_newton_up,
                         [&](const DeviceReading&) { return rig_->motor_output().norm() > 0.0; }));
  device->close();
  EXPECT_TRUE(motors_become_silent());
  for (int i = 0; i < 10; ++i) EXPECT_NE(tick(*device, half_newton_up).status, DeviceStatus::kReady);
  EXPECT_EQ(rig_->motor_output(), Eigen::Vector3d::Zero());
  device->close();
  EXPECT_EQ(rig_->motor_output(), Eigen::Vector3d::Zero());
}

TEST_P(DeviceConformance, DestructionWithoutCloseLeavesNoForce) {
  auto device = rig_->open();
  ASSERT_TRUE(tick_until(*device, kPatience_s, half_newton_up,
                         [&](const DeviceReading&) { return rig_->motor_output().norm() > 0.0; }));
  device.reset();
  EXPECT_TRUE(motors_become_silent());
}

TEST_P(DeviceConformance, OpensAgainAfterClosing) {
  for (int i = 0; i < 2; ++i) {
    t_ns_ = 0;
    const auto device = rig_->open();
    EXPECT_TRUE(tick_until(*device, kPatience_s, no_force,
                           [](const DeviceReading& r) { return r.sequence > 0 && r.status == DeviceStatus::kReady; }));
  }
}

TEST_P(DeviceConformance, SecondOwnerIsRefusedInWords) {
  if (!rig_->exclusive()) return;
  const auto device = rig_->open();
  try {
    const auto second = rig_->open();
    ADD_FAILURE() << "opened twice";
  } catch (const Error& error) {
    EXPECT_FALSE(std::string(error.what()).empty());
  }
  EXPECT_TRUE(tick_until(*device, kPatience_s, half_newton_up, [&](const DeviceReading&) {
    return rig_->motor_output().norm() > 0.0;
  })) << "the first owner lost its device";
}

TEST_P(DeviceConformance, SurvivesUnplugging) {
  if (!rig_->can_unplug()) return;
  const auto device = rig_->open();
  ASSERT_TRUE(tick_until(*device, kPatience_s, half_newton_up,
                         [&](const DeviceReading&) { return rig_->motor_output().norm() > 0.0; }));
  rig_->unplug();
  ASSERT_TRUE(tick_until(*device, kPatience_s, half_newton_up,
                         [](const DeviceReading& r) { return r.status == DeviceStatus::kFault; }));
  EXPECT_NE(device->fault(), "");
  EXPECT_TRUE(motors_become_silent());
  for (int i = 0; i < 20; ++i) {
    const DeviceReading reading = tick(*device, half_newton_up);
    EXPECT_EQ(reading.status, DeviceStatus::kFault);
    EXPECT_TRUE(reading.p_m.allFinite() && reading.v_mps.allFinite());
  }
  EXPECT_EQ(rig_->motor_output(), Eigen::Vector3d::Zero());
  device->close();
}

TEST_P(DeviceConformance, TellsAStall) {
  if (!rig_->can_stall()) return;
  const auto device = rig_->open();
  ASSERT_TRUE(tick_until(*device, kPatience_s, half_newton_up,
                         [&](const DeviceReading& r) { return r.status == DeviceStatus::kReady && r.sequence > 0; }));
  rig_->stall();
  EXPECT_TRUE(tick_until(*device, rig_->stalled_within_s(), half_newton_up, [](const DeviceReading& r) {
    return r.status == DeviceStatus::kStalled || r.status == DeviceStatus::kFault;
  }));
  device->close();
}

}  // namespace asperity::testing_devices
