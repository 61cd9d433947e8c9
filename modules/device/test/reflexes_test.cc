#include "asperity/device/reflexes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "../src/run_servo_on.h"
#include "asperity/device/supervisor.h"
#include "servo_rig.h"

namespace asperity {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A device that is read once a millisecond.
struct Watched {
  ReflexConfig config;
  ReflexState state;
  std::uint64_t sequence = 0;
  ReadingJudgement see(const Eigen::Vector3d& p_m, const Eigen::Vector3d& v_mps, bool is_new = true) {
    DeviceReading reading;
    reading.p_m = p_m;
    reading.v_mps = v_mps;
    reading.sequence = is_new ? ++sequence : sequence;
    return check_reading(config, state, reading, 1e-3);
  }
  ReadingJudgement see(double x_m, double v_mps = kNan, bool is_new = true) {
    return see({x_m, 0.0, 0.0}, Eigen::Vector3d::Constant(v_mps).cwiseProduct(Eigen::Vector3d(1.0, 0.0, 0.0)), is_new);
  }
};

TEST(Reflexes, AHandIsBelieved) {
  // 0.1 m back and forth at 5 Hz: 3.1 m/s at most, faster than hands stroke; with and without a stated velocity.
  for (const bool states : {true, false}) {
    Watched hand;
    for (int k = 0; k < 2000; ++k) {
      const double w = 2.0 * std::numbers::pi * 5.0, t = 1e-3 * k;
      const Eigen::Vector3d p(0.1 * std::sin(w * t), 0.0, 0.0);
      const Eigen::Vector3d v(0.1 * w * std::cos(w * t), 0.0, 0.0);
      const ReadingJudgement seen = hand.see(p, states ? v : Eigen::Vector3d::Constant(kNan));
      ASSERT_TRUE(seen.plausible && !seen.fault) << k;
    }
  }
}

TEST(Reflexes, NewsOfAHundredHertzIsBelieved) {
  Watched hand;
  for (int k = 0; k < 2000; ++k) {
    const int news = k / 10;
    ASSERT_TRUE(hand.see(0.01 * news * 1.0, 1.0, k % 10 == 0).plausible) << k;  // 1 m/s
  }
}

TEST(Reflexes, AJumpIsNotBelievedAndForgivenOnce) {
  Watched hand;
  for (int k = 0; k < 100; ++k) hand.see(0.0);
  EXPECT_FALSE(hand.see(0.05).plausible);
  const ReadingJudgement back = hand.see(0.0);
  EXPECT_TRUE(back.plausible && back.returned && !back.fault);
  EXPECT_FALSE(hand.see(0.0).returned);
}

TEST(Reflexes, AnotherPlaceIsBelievedWhenAHandCouldHaveComeThere) {
  Watched hand;
  for (int k = 0; k < 100; ++k) hand.see(0.0);
  int ticks = 0;
  for (;;) {
    const ReadingJudgement seen = hand.see(0.05);
    ASSERT_FALSE(seen.fault);
    ++ticks;
    if (seen.plausible) break;
  }
  EXPECT_NEAR(ticks, 10, 1);  // 50 mm at 5 m/s
}

TEST(Reflexes, JumpsThatGoOnAreAFault) {
  Watched far, flicker;
  for (int k = 0; k < 100; ++k) far.see(0.0), flicker.see(0.0);
  int ticks = 0;
  while (!far.see(1.0).fault && ticks < 1000) ++ticks;
  EXPECT_NEAR(ticks, 25, 2);  // fault_after_s
  ticks = 0;
  while (!flicker.see(ticks % 2 == 0 ? 0.05 : 0.0).fault && ticks < 1000) ++ticks;
  EXPECT_NEAR(ticks, 50, 5);  // every other one is plausible
}

TEST(Reflexes, APlaceThatStandsWhileItMovesIsNotBelieved) {
  Watched hand;
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(hand.see(1e-4 * k, 0.1).plausible);
  int ticks = 0;
  while (hand.see(1e-4 * 99, 0.1).plausible && ticks < 1000) ++ticks;
  EXPECT_NEAR(ticks, 50, 2);
  while (!hand.see(1e-4 * 99, 0.1).fault && ticks < 1000) ++ticks;
  EXPECT_NEAR(ticks, 75, 3);
  // At rest it may stand for ever.
  Watched resting;
  for (int k = 0; k < 5000; ++k) ASSERT_TRUE(resting.see(0.0, 0.0).plausible);
}

TEST(Reflexes, AVelocityThatContradictsTheStepsIsNotBelieved) {
  Watched hand;
  bool believed = true;
  for (int k = 0; k < 200; ++k) believed = hand.see(2e-3 * k, -2.0).plausible && believed;  // 2 m/s there, 2 m/s back
  EXPECT_FALSE(believed);
  // A velocity that is filtered by 20 ms lags behind a stroke that turns around, and is believed.
  Watched filtered;
  double v = 0.0, x_before = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double x = 0.05 * std::sin(2.0 * std::numbers::pi * 3.0 * 1e-3 * k);
    v += 0.05 * ((x - x_before) / 1e-3 - v);
    x_before = x;
    ASSERT_TRUE(filtered.see(x, v).plausible) << k;
  }
}

TEST(Reflexes, OnlyASuspendedMachineHasClocksThatPart) {
  SuspendWatch watch;
  EXPECT_FALSE(was_suspended(watch, 5'000'000'000, 1'000'000'000, 0.01));
  EXPECT_FALSE(was_suspended(watch, 9'000'000'000, 5'000'000'000, 0.01));
  EXPECT_TRUE(was_suspended(watch, 13'100'000'000, 9'000'000'000, 0.01));
  EXPECT_FALSE(was_suspended(watch, 13'200'000'000, 9'100'000'000, 0.01));
}

// The hand rests 1 mm off a wall of 1 N/mm; `jumps` readings are `deep_m` deeper.
Recorded glitch(int jumps, double deep_m) {
  FakeDevice device;
  device.path = [=](std::uint64_t read) {
    const bool jumped = read >= 1000 && read < 1000 + static_cast<std::uint64_t>(jumps);
    return Eigen::Vector3d(0.0, 0.0, jumped ? 0.001 - deep_m : 0.001);
  };
  device.meddle = [](std::uint64_t, DeviceReading& reading) { reading.v_mps.setConstant(kNan); };
  return run(device, unpaced(2.0));
}

double largest_force_N(const Recorded& all) {
  double most = 0.0;
  for (const ServoTick& tick : all.ticks) most = std::max(most, tick.out_world_N.norm());
  return most;
}

TEST(Reflexes, NoGlitchKicks) {
  for (const double deep_m : {0.001, 0.0015, 0.002, 0.003, 0.005, 0.01, 0.02, 0.05}) {
    for (const int jumps : {1, 2, 3, 8}) {
      SCOPED_TRACE(testing::Message() << jumps << " readings " << deep_m << " m deeper");
      const Recorded all = glitch(jumps, deep_m);
      EXPECT_EQ(all.result.end, ServoEnd::kDuration);
      EXPECT_LE(largest_force_N(all), 0.1);
    }
  }
  // A place that no hand reaches in 25 ms.
  const Recorded far = glitch(1000, 0.2);
  EXPECT_EQ(far.result.end, ServoEnd::kFault);
  EXPECT_EQ(far.result.fault, ReflexFault::kImplausible);
  EXPECT_LE(largest_force_N(far), 0.1);
}

// A device of 100 Hz, or one that was silent for 10 ms.
TEST(Reflexes, NoGlitchOfASlowDeviceKicks) {
  for (const double deep_m : {0.007, 0.02, 0.05}) {
    for (const int jumps : {1, 2}) {
      SCOPED_TRACE(testing::Message() << jumps << " readings " << deep_m << " m deeper");
      FakeDevice device;
      device.path = [=](std::uint64_t read) {
        const std::uint64_t news = read / 10;
        return Eigen::Vector3d(0.0, 0.0,
                               news >= 100 && news < 100 + static_cast<std::uint64_t>(jumps) ? 0.001 - deep_m : 0.001);
      };
      device.meddle = [](std::uint64_t read, DeviceReading& reading) {
        reading.v_mps.setConstant(kNan);
        reading.sequence = 1 + read / 10;
      };
      const Recorded all = run(device, unpaced(2.0));
      EXPECT_EQ(all.result.end, ServoEnd::kDuration);
      // One that lasts is a place; it begins softly, over 10 ms.
      EXPECT_LE(largest_force_N(all), jumps == 1 ? 0.1 : 0.5);
    }
  }
}

TEST(Reflexes, AHandThatStartsAndStopsAtOnceIsBelieved) {
  // From rest to 0.5 m/s within a millisecond and back, against a stop: 500 m/s².
  Watched hand;
  double x = 0.0;
  for (int k = 0; k < 400; ++k) {
    if (k >= 100 && k < 200) x += 0.5e-3;
    ASSERT_TRUE(hand.see(x).plausible) << k;
  }
}

TEST(Reflexes, SurprisesThatDoNotConfirmOneAnotherAreAFault) {
  Watched hand;
  for (int k = 0; k < 100; ++k) hand.see(0.0);
  int ticks = 0;
  while (!hand.see((ticks % 2 == 0 ? 0.004 : 0.012) + 1e-5 * ticks).fault && ticks < 1000) ++ticks;
  EXPECT_NEAR(ticks, 50, 5);  // after some milliseconds a hand could have come to every other one
}

TEST(Reflexes, LongGapsAddUp) {
  const ReflexConfig config;
  LostTicks often, seldom, short_ones;
  int gaps = 0;
  while (!lost_too_much(config, often, 0.019) && gaps < 1000) ++gaps;  // a loop of 53 Hz
  EXPECT_NEAR(gaps, 8, 1);
  for (int k = 0; k < 10000; ++k) {
    ASSERT_FALSE(lost_too_much(config, short_ones, 0.009)) << k;
    ASSERT_FALSE(lost_too_much(config, seldom, k % 200 == 0 ? 0.015 : 0.001)) << k;
  }
  LostTicks once;
  EXPECT_TRUE(lost_too_much(config, once, 0.16));
}

TEST(Reflexes, AHandThatIsElsewhereBeginsSoftly) {
  const Recorded all = glitch(1000, 0.05);
  EXPECT_EQ(all.result.end, ServoEnd::kDuration);
  const SafetyConfig safety;
  for (std::size_t k = 1000; k < 1500; ++k) {
    const double since_s = 1e-3 * (static_cast<double>(k) - 1009.0);  // believed after 10 ms
    EXPECT_LE(all.ticks[k].out_world_N.norm(),
              std::max(0.0, since_s + 2e-3) / safety.soft_start_s * safety.max_force_N + 1e-9)
        << k;
  }
}

TEST(Reflexes, AGlitchWhilePressingAddsNothing) {
  FakeDevice device;
  device.path = [](std::uint64_t read) {
    return Eigen::Vector3d(0.0, 0.0, read == 1000 || read == 1001 ? -0.04 : -1e-3);
  };
  device.meddle = [](std::uint64_t, DeviceReading& reading) { reading.v_mps.setConstant(kNan); };
  const Recorded all = run(device, unpaced(3.0));
  ASSERT_EQ(all.result.end, ServoEnd::kDuration);
  for (const ServoTick& tick : all.ticks) EXPECT_LE(tick.out_world_N.norm(), 1.0 + 1e-9);
  // Held and falling while it lasts, then from nothing.
  EXPECT_LE(all.ticks[1001].out_world_N.norm(), all.ticks[999].out_world_N.norm());
  EXPECT_LT(all.ticks[1003].out_world_N.norm(), 0.96);
}

std::int64_t suspends_after_a_while() noexcept {
  static int calls = 0;
  return boot_now_ns() + (++calls > 300 ? 3'600'000'000'000 : 0);
}

TEST(Reflexes, ASuspendedMachineIsAFault) {
  FakeDevice device;
  device.path = pressed;
  ServoConfig config;
  config.duration_s = 5.0;
  config.priority = RealTimePriority::kIgnore;
  SnapshotExchange<const RenderModel> scene(wall(1000.0));
  const std::atomic<bool> stop{false};
  std::uint64_t ticks = 0;
  const ServoResult result = run_servo_on(
      &suspends_after_a_while, device, scene, config, stop, [&](const ServoTick&) { ++ticks; }, wall_step);
  EXPECT_EQ(result.end, ServoEnd::kFault);
  EXPECT_EQ(result.fault, ReflexFault::kSuspended);
  EXPECT_EQ(ticks, 301u);
  EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
}

TEST(Reflexes, ALoopThatWasNotRunIsAFault) {
  FakeDevice device;
  device.path = pressed;
  device.meddle = [](std::uint64_t read, DeviceReading&) {
    if (read != 50) return;
    const std::int64_t until_ns = boot_now_ns() + 200'000'000;
    while (boot_now_ns() < until_ns) {
    }
  };
  ServoConfig config;
  config.duration_s = 5.0;
  config.priority = RealTimePriority::kIgnore;
  const Recorded all = run(device, config);
  EXPECT_EQ(all.result.end, ServoEnd::kFault);
  EXPECT_EQ(all.result.fault, ReflexFault::kLostTicks);
  EXPECT_EQ(device.force_N, Eigen::Vector3d::Zero());
}

TEST(Reflexes, AComputedHandIsNotJudged) {
  FakeDevice device;
  device.device_info.simulated = true;
  device.path = [](std::uint64_t read) { return Eigen::Vector3d(read % 2 == 0 ? 0.3 : 0.0, 0.0, 0.0); };
  EXPECT_EQ(run(device, unpaced(0.2)).result.end, ServoEnd::kDuration);
}

}  // namespace
}  // namespace asperity
