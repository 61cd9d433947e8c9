#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "asperity/device/make_safe.h"
#include "asperity/device/safety_cause.h"
#include "asperity/device/staleness.h"
#include "limit_force.h"

namespace asperity {
namespace {

constexpr double kTick_s = 1e-3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// Immediately at full force, no passivity controller: one stage at a time.
SafetyConfig plain() {
  SafetyConfig config;
  config.soft_start_s = 0.0;
  config.passivity = false;
  return config;
}

SafetyInput touching(std::uint64_t k, const Eigen::Vector3d& force_N) {
  SafetyInput input;
  input.force_N = force_N;
  input.sequence = k + 1;
  return input;
}

TEST(LimitForce, KeepsTheDirection) {
  const Eigen::Vector3d force(3.0, -4.0, 12.0);
  EXPECT_EQ(limit_force(force, 13.0), force);
  EXPECT_LT((limit_force(force, 6.5) - 0.5 * force).norm(), 1e-15);
  EXPECT_EQ(limit_force(force, 0.0), Eigen::Vector3d::Zero());
  EXPECT_EQ(limit_force(Eigen::Vector3d(1.0, kNan, 0.0), 5.0), Eigen::Vector3d::Zero());
  EXPECT_EQ(limit_force(Eigen::Vector3d(-kInf, 0.0, 0.0), 5.0), Eigen::Vector3d::Zero());
  const Eigen::Vector3d huge = limit_force(Eigen::Vector3d(1e300, 0.0, 0.0), 5.0);
  EXPECT_NEAR(huge.x(), 5.0, 1e-12);
}

TEST(LimitForceRate, MovesAlongTheSegment) {
  const Eigen::Vector3d from(1.0, 0.0, 0.0), to(1.0, 5.0, 0.0);
  EXPECT_LT((limit_force_rate(from, to, 2000.0, kTick_s) - Eigen::Vector3d(1.0, 2.0, 0.0)).norm(), 1e-15);
  EXPECT_EQ(limit_force_rate(from, to, 5000.0, kTick_s), to);
  EXPECT_EQ(limit_force_rate(from, from, 0.0, kTick_s), from);
}

TEST(ForceGain, GrowsAndFallsLinearly) {
  const SafetyConfig config;  // 0.5 s up, 20 ms down
  double gain = 0.0;
  for (int k = 1; k <= 250; ++k) gain = next_gain(gain, true, config, kTick_s);
  EXPECT_NEAR(gain, 0.5, 1e-12);
  for (int k = 1; k <= 5; ++k) gain = next_gain(gain, false, config, kTick_s);
  EXPECT_NEAR(gain, 0.25, 1e-12);
  for (int k = 1; k <= 6; ++k) gain = next_gain(gain, false, config, kTick_s);
  EXPECT_EQ(gain, 0.0);
  for (int k = 1; k <= 501; ++k) gain = next_gain(gain, true, config, kTick_s);
  EXPECT_EQ(gain, 1.0);
}

TEST(Staleness, CountsFromTheLastNews) {
  Staleness staleness;
  EXPECT_FALSE(is_stale(staleness, 7, DeviceStatus::kReady, 0.02, kTick_s));
  for (int k = 1; k < 20; ++k) EXPECT_FALSE(is_stale(staleness, 7, DeviceStatus::kReady, 0.02, kTick_s)) << k;
  EXPECT_TRUE(is_stale(staleness, 7, DeviceStatus::kReady, 0.02, kTick_s));
  EXPECT_TRUE(is_stale(staleness, 8, DeviceStatus::kStalled, 0.02, kTick_s));
  EXPECT_FALSE(is_stale(staleness, 8, DeviceStatus::kReady, 0.02, kTick_s));
  // A device that is served at 1 kHz and has news at 100 Hz is not stale.
  for (std::uint64_t k = 0; k < 100; ++k)
    EXPECT_FALSE(is_stale(staleness, 9 + k / 10, DeviceStatus::kReady, 0.02, kTick_s));
}

TEST(Staleness, ASecondSilenceWithinASecondHoldsTheForceAtZero) {
  Stammer stammer;
  int held = 0;
  const auto pass = [&](bool stale, int ticks) {
    for (int k = 0; k < ticks; ++k) held += is_stammering(stammer, stale, kTick_s) ? 1 : 0;
  };
  pass(false, 100);
  pass(true, 30);
  pass(false, 500);
  EXPECT_EQ(held, 0);  // one silence costs nothing more
  pass(true, 30);
  pass(false, 2000);
  EXPECT_NEAR(held, 250, 1);
  pass(true, 30);
  pass(false, 100);
  EXPECT_NEAR(held, 250, 1);  // more than a second later
  held = 0;
  for (int k = 0; k < 20; ++k) {  // answers that are 60 ms late
    pass(true, 40);
    pass(false, 20);
  }
  EXPECT_NEAR(held, 1200, 2);
}

TEST(MakeSafe, PassesWhatIsSafe) {
  SafetyState state;
  for (std::uint64_t k = 0; k < 100; ++k) {
    const Eigen::Vector3d force(std::sin(0.1 * static_cast<double>(k)), 0.5, -1.0);
    const SafeForce safe = make_safe(plain(), state, touching(k, force));
    EXPECT_EQ(safe.force_N, force);
    EXPECT_EQ(safe.limited_by, 0U);
  }
}

TEST(MakeSafe, LimitsForceThenRate) {
  SafetyState state;
  const Eigen::Vector3d force(0.0, 0.0, 82.0);  // a peak of a stuck proxy
  for (std::uint64_t k = 0; k < 5; ++k) {
    const SafeForce safe = make_safe(plain(), state, touching(k, force));
    EXPECT_NEAR(safe.force_N.z(), std::min(5.0, 2.0 * static_cast<double>(k + 1)), 1e-12);
    EXPECT_EQ(safe.limited_by, flag(SafetyCause::kForceLimit) | (k < 2 ? flag(SafetyCause::kRateLimit) : 0U));
  }
}

TEST(MakeSafe, StartsSoftly) {
  SafetyConfig config = plain();
  config.soft_start_s = 0.5;
  SafetyState state;
  for (std::uint64_t k = 0; k < 600; ++k) {
    const SafeForce safe = make_safe(config, state, touching(k, Eigen::Vector3d(0.0, 2.0, 0.0)));
    EXPECT_NEAR(safe.force_N.y(), 2.0 * std::min(1.0, static_cast<double>(k + 1) / 500.0), 1e-9);
    if (k < 498 || k > 500) {
      EXPECT_EQ(safe.limited_by, k < 498 ? flag(SafetyCause::kSoftStart) : 0U);
    }
  }
}

TEST(MakeSafe, RampsToZeroOnNumbersThatAreNone) {
  for (int where = 0; where < 3; ++where) {
    SafetyState state;
    for (std::uint64_t k = 0; k < 10; ++k) make_safe(plain(), state, touching(k, Eigen::Vector3d(0.0, 0.0, 4.0)));
    for (std::uint64_t k = 10; k < 40; ++k) {
      SafetyInput input = touching(k, Eigen::Vector3d(0.0, 0.0, 4.0));
      (where == 0 ? input.force_N : where == 1 ? input.hand_m : input.hand_mps).y() = where == 2 ? kInf : kNan;
      const SafeForce safe = make_safe(plain(), state, input);
      EXPECT_NEAR(safe.force_N.z(), 4.0 * std::max(0.0, 1.0 - static_cast<double>(k - 9) / 20.0), 1e-9);
      EXPECT_TRUE(safe.limited_by & flag(SafetyCause::kNonFinite));
    }
    EXPECT_TRUE(is_at_rest(state));
    // Well again: with plain() at once, but no faster than the rate limit.
    EXPECT_NEAR(make_safe(plain(), state, touching(40, Eigen::Vector3d(0.0, 0.0, 4.0))).force_N.z(), 2.0, 1e-12);
  }
}

TEST(MakeSafe, NothingIsHeldThatWasNeverFinite) {
  SafetyState state;
  const SafeForce safe = make_safe(plain(), state, touching(0, Eigen::Vector3d::Constant(kNan)));
  EXPECT_EQ(safe.force_N, Eigen::Vector3d::Zero());
}

TEST(MakeSafe, StalePositionRampsDownAndResumesSoftly) {
  SafetyConfig config = plain();
  SafetyState state;
  const Eigen::Vector3d force(0.0, 0.0, 4.0);
  for (std::uint64_t k = 0; k < 10; ++k) make_safe(config, state, touching(k, force));
  config.soft_start_s = 0.5;
  std::vector<double> z;
  for (int k = 1; k <= 60; ++k) z.push_back(make_safe(config, state, touching(9, force)).force_N.z());
  EXPECT_DOUBLE_EQ(z[18], 4.0);         // 19 ms without news
  EXPECT_NEAR(z[19 + 9], 2.0, 1e-9);    // half of the ramp
  EXPECT_NEAR(z[19 + 20], 0.0, 1e-12);  // its end
  for (std::uint64_t k = 10; k < 60; ++k) {
    EXPECT_NEAR(make_safe(config, state, touching(k, force)).force_N.z(), 4.0 * static_cast<double>(k - 9) / 500.0,
                1e-9);
  }
}

// The loop was not run for 8 ms: three ticks of the rate limit and of the gain, not eight.
TEST(MakeSafe, AShortStallOfTheLoopIsNotMadeUpFor) {
  SafetyConfig config = plain();
  config.max_force_rate_N_per_s = 500.0;
  SafetyState state;
  make_safe(config, state, touching(0, Eigen::Vector3d::Zero()));
  SafetyInput input = touching(1, Eigen::Vector3d(0.0, 0.0, 4.0));
  input.dt_s = 8e-3;
  EXPECT_NEAR(make_safe(config, state, input).force_N.z(), 3 * 0.5, 1e-12);
  config.soft_start_s = 0.5;
  state = {};
  make_safe(config, state, touching(0, Eigen::Vector3d::Zero()));
  make_safe(config, state, input);
  EXPECT_NEAR(state.gain, 4.0 / 500.0, 1e-12);
}

// Not run for longer than stale_after_s: whatever is rendered where the hand is now begins from zero.
TEST(MakeSafe, ALongStallOfTheLoopBeginsSoftlyAgain) {
  SafetyConfig config = plain();
  SafetyState state;
  make_safe(config, state, touching(0, Eigen::Vector3d::Zero()));
  config.soft_start_s = 0.5;
  SafetyInput input = touching(1, Eigen::Vector3d(0.0, 0.0, 5.0));
  input.dt_s = 3.0;
  const SafeForce first = make_safe(config, state, input);
  EXPECT_EQ(first.force_N, Eigen::Vector3d::Zero());
  EXPECT_TRUE(first.limited_by & flag(SafetyCause::kStale));
  for (std::uint64_t k = 1; k < 500; ++k) {
    EXPECT_NEAR(make_safe(config, state, touching(k + 1, Eigen::Vector3d(0.0, 0.0, 5.0))).force_N.z(),
                5.0 * static_cast<double>(k) / 500.0, 1e-9);
  }
}

TEST(MakeSafe, FaultIsZeroAtOnce) {
  SafetyState state;
  for (std::uint64_t k = 0; k < 10; ++k) make_safe(plain(), state, touching(k, Eigen::Vector3d(0.0, 0.0, 4.0)));
  SafetyInput input = touching(10, Eigen::Vector3d(0.0, 0.0, 4.0));
  input.status = DeviceStatus::kFault;
  const SafeForce safe = make_safe(plain(), state, input);
  EXPECT_EQ(safe.force_N, Eigen::Vector3d::Zero());
  EXPECT_EQ(safe.limited_by, flag(SafetyCause::kFault));
  EXPECT_TRUE(is_at_rest(state));
}

TEST(MakeSafe, ADevicesLimitLowersOurs) {
  DeviceInfo info;
  EXPECT_EQ(lower_to_device(SafetyConfig{}, info).max_force_N, 5.0);  // it states none
  info.max_force_N = 3.3;
  EXPECT_EQ(lower_to_device(SafetyConfig{}, info).max_force_N, 3.3);
  info.max_force_N = 40.0;
  EXPECT_EQ(lower_to_device(SafetyConfig{}, info).max_force_N, 5.0);
}

// Whatever comes in: finite, within the limit, and no faster than the rate limit but for a fault.
TEST(MakeSafe, HoldsItsLimitsAgainstAnything) {
  Random random(3);
  const double odd[] = {kNan, kInf, -kInf, 1e308, -1e308, 0.0, 1e-320};
  const auto any = [&] {
    const double u = random.uniform(0.0, 1.0);
    return u < 0.1 ? odd[static_cast<std::size_t>(random.uniform(0.0, 6.999))] : random.uniform(-20.0, 20.0);
  };
  SafetyConfig config;
  config.soft_start_s = 0.01;
  SafetyState state;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (std::uint64_t k = 0; k < 20'000; ++k) {
    SafetyInput input;
    input.force_N = Eigen::Vector3d(any(), any(), any());
    input.hand_m = 0.01 * Eigen::Vector3d(any(), any(), any());
    input.hand_mps = Eigen::Vector3d(any(), any(), any());
    input.sequence = random.uniform(0.0, 1.0) < 0.5 ? k : 0;
    input.status = random.uniform(0.0, 1.0) < 0.01 ? DeviceStatus::kFault : DeviceStatus::kReady;
    input.spring_N = 10.0 * Eigen::Vector3d(any(), any(), any());
    input.stretch_m = Eigen::Vector3d(any(), any(), any());
    input.scene_changed = random.uniform(0.0, 1.0) < 0.1;
    const SafeForce safe = make_safe(config, state, input);
    ASSERT_TRUE(safe.force_N.allFinite());
    ASSERT_LE(safe.force_N.norm(), config.max_force_N * (1.0 + 1e-12));
    if (input.status != DeviceStatus::kFault) {
      ASSERT_LE((safe.force_N - last).norm(), config.max_force_rate_N_per_s * kTick_s * (1.0 + 1e-9));
    } else {
      ASSERT_EQ(safe.force_N, Eigen::Vector3d::Zero());
    }
    last = safe.force_N;
  }
  // And nothing of it stays.
  SafeForce safe;
  for (std::uint64_t k = 0; k < 1000; ++k) safe = make_safe(config, state, touching(30'000 + k, {0.0, 0.0, 2.0}));
  EXPECT_EQ(safe.force_N, Eigen::Vector3d(0.0, 0.0, 2.0));
  EXPECT_EQ(safe.limited_by, 0U);
}

TEST(MakeSafe, RecoversFromNumbersThatOverflow) {
  for (const double huge : {1e308, -1e308}) {
    SafetyConfig config;
    config.soft_start_s = 0.0;
    SafetyState state;
    for (std::uint64_t k = 0; k < 10; ++k) {
      SafetyInput input = touching(k, {0.0, 0.0, 2.0});
      input.spring_N = input.force_N;
      input.hand_m.setConstant(k % 2 == 0 ? huge : 0.0);
      input.stretch_m.setConstant(std::abs(huge));
      ASSERT_TRUE(make_safe(config, state, input).force_N.allFinite());
    }
    SafeForce safe;
    for (std::uint64_t k = 10; k < 100; ++k) safe = make_safe(config, state, touching(k, {0.0, 0.0, 2.0}));
    EXPECT_EQ(safe.force_N, Eigen::Vector3d(0.0, 0.0, 2.0));
    EXPECT_EQ(safe.limited_by, 0U);
  }
}

TEST(SafetyCause, Names) {
  EXPECT_EQ(cause_names(0), "");
  EXPECT_EQ(cause_names(flag(SafetyCause::kStale) | flag(SafetyCause::kRateLimit)), "stale+rate-limit");
  EXPECT_EQ(cause_names(flag(SafetyCause::kFault)), "fault");
  EXPECT_EQ(cause_names(flag(SafetyCause::kNotPermitted)), "not-permitted");
}

}  // namespace
}  // namespace asperity
