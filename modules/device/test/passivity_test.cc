#include "asperity/device/passivity.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/device/make_safe.h"
#include "asperity/device/safety_cause.h"

namespace asperity {
namespace {

constexpr double kTick_s = 1e-3;

// A hand of mass m with a damper b, pushed with a constant force against the wall z < 0 of stiffness k that is
// rendered once a tick. Between ticks the force is constant, and the motion is exact to 1/50 of a tick.
struct Wall {
  double stiffness_N_per_m = 5000.0;
  double mass_kg = 0.15;
  double damping_N_s_per_m = 1.5;
  double push_N = -1.0;
  double start_mps = -0.1;
};

struct Bounce {
  double late_swing_m = 0.0;  // peak to peak over the last half second
  double mean_late_m = 0.0;
  double dissipated_J = 0.0;
  std::size_t damped_ticks = 0;
};

Bounce bounce(const Wall& wall, SafetyConfig config, double duration_s) {
  config.soft_start_s = 0.0;
  constexpr int kParts = 50;
  SafetyState state;
  Bounce result;
  double z = 1e-3, v = wall.start_mps;
  double low = 1.0, high = -1.0, sum = 0.0;
  const int ticks = static_cast<int>(duration_s / kTick_s), late = 500;
  for (int k = 0; k < ticks; ++k) {
    SafetyInput input;
    input.force_N.z() = wall.stiffness_N_per_m * std::max(-z, 0.0);
    input.spring_N = input.force_N;
    input.stretch_m.z() = std::max(-z, 0.0);
    input.hand_m.z() = z;
    input.hand_mps.z() = v;
    input.sequence = static_cast<std::uint64_t>(k) + 1;
    const SafeForce safe = make_safe(config, state, input);
    result.dissipated_J += safe.dissipated_J;
    if (safe.limited_by & flag(SafetyCause::kPassivity)) ++result.damped_ticks;
    for (int part = 0; part < kParts; ++part) {
      v += (safe.force_N.z() + wall.push_N - wall.damping_N_s_per_m * v) / wall.mass_kg * kTick_s / kParts;
      z += v * kTick_s / kParts;
    }
    if (k >= ticks - late) {
      low = std::min(low, z);
      high = std::max(high, z);
      sum += z;
    }
  }
  result.late_swing_m = high - low;
  result.mean_late_m = sum / late;
  return result;
}

// b = 1.5 N s/m is above what is assumed and below k T/2 = 2.5 N s/m (Colgate and Brown 1994): the wall feeds the hand,
// which never rests.
TEST(Passivity, SettlesAWallThatWouldLimitCycle) {
  SafetyConfig off;
  off.passivity = false;
  const Bounce without = bounce(Wall{}, off, 5.0);
  EXPECT_GT(without.late_swing_m, 0.2e-3);
  const Bounce with = bounce(Wall{}, SafetyConfig{}, 5.0);
  EXPECT_LT(with.late_swing_m, 0.05 * without.late_swing_m);
  EXPECT_NEAR(with.mean_late_m, -1.0 / 5000.0, 20e-6);  // rests where the push and the wall balance
  EXPECT_GT(with.dissipated_J, 0.0);
  RecordProperty("without_um", std::to_string(1e6 * without.late_swing_m));
  RecordProperty("with_um", std::to_string(1e6 * with.late_swing_m));
}

// b = 5 N s/m is above k T/2 = 0.5 N s/m: stable by itself, and the controller leaves the rest alone.
TEST(Passivity, LeavesAStableWallWhereItRests) {
  Wall wall;
  wall.stiffness_N_per_m = 1000.0;
  wall.damping_N_s_per_m = 5.0;
  const Bounce with = bounce(wall, SafetyConfig{}, 5.0);
  EXPECT_LT(with.late_swing_m, 1e-7);
  EXPECT_NEAR(with.mean_late_m, -1e-3, 1e-6);
}

// A passive spring with friction: presses, holds, strokes, releases; the hand's path is given. Friction takes
// more than sampling creates, so the controller must not act, however long the spring is held.
TEST(Passivity, DoesNotTouchAPassiveSpringWithFriction) {
  const SafetyConfig config;
  PassivityState state;
  for (int k = 0; k < 20'000; ++k) {
    const double t_s = kTick_s * k;
    PassivityInput input;
    const double phase = std::fmod(t_s, 4.0);
    const double z = phase < 1.0 ? 2e-3 - 4e-3 * phase : phase < 3.0 ? -2e-3 : -2e-3 + 4e-3 * (phase - 3.0);
    input.hand_m = Eigen::Vector3d(0.02 * std::sin(2.0 * t_s), 0.0, z);
    input.hand_mps = Eigen::Vector3d(0.04 * std::cos(2.0 * t_s), 0.0, 0.0);
    const double pressed_N = 1000.0 * std::max(-z, 0.0);
    input.touching = pressed_N > 0.0;
    input.stored_J = 0.5 * pressed_N * std::max(-z, 0.0);
    ASSERT_EQ(dissipate_created_energy(config, state, input), Eigen::Vector3d::Zero()) << k;
    const double along = input.hand_mps.x() > 0.0 ? 1.0 : -1.0;
    state.force_N = Eigen::Vector3d(-0.3 * pressed_N * along, 0.0, pressed_N);
  }
}

// The energy of a sampled spring that is left again, in closed form: entering and leaving in n steps of dx each with
// the force of the step before creates k dx² n, of which E may not lose any.
TEST(Passivity, ObservesTheSampledEnergyExactly) {
  SafetyConfig config;
  config.max_damping_N_s_per_m = 0.0;
  config.debt_leak_s = 1e9;
  config.assumed_damping_N_s_per_m = 0.0;
  config.max_debt_J = 10.0;
  PassivityState state;
  const double k_N_per_m = 2000.0, dx = 1e-4;
  const int n = 20;
  for (int k = 0; k <= 2 * n; ++k) {
    PassivityInput input;
    input.hand_m.z() = -dx * (k <= n ? k : 2 * n - k);
    input.stored_J = 0.5 * k_N_per_m * input.hand_m.squaredNorm();
    input.touching = true;
    dissipate_created_energy(config, state, input);
    state.force_N.z() = -k_N_per_m * input.hand_m.z();
  }
  EXPECT_NEAR(state.excess_J, -k_N_per_m * dx * dx * n, 1e-9);
}

TEST(Passivity, EnergyOfASpringThatSaturates) {
  const Eigen::Vector3d stretch(0.0, 3e-3, 4e-3);
  EXPECT_NEAR(spring_energy_J(1000.0 * stretch, stretch, 10.0), 0.5 * 1000.0 * 25e-6, 1e-15);
  // Limited to 2 N it follows k L² / 2 to 2 mm, then 2 N over 3 mm more.
  EXPECT_NEAR(spring_energy_J(1000.0 * stretch, stretch, 2.0), 0.5 * 1000.0 * 4e-6 + 2.0 * 3e-3, 1e-15);
  EXPECT_EQ(spring_energy_J(-stretch, stretch, 2.0), 0.0);
  EXPECT_EQ(spring_energy_J(stretch, Eigen::Vector3d::Zero(), 2.0), 0.0);
}

TEST(Passivity, DampingIsBoundedAndAgainstTheVelocity) {
  const SafetyConfig config;
  PassivityState state;
  state.excess_J = -1e-3;
  PassivityInput input;
  input.touching = true;
  input.hand_mps = Eigen::Vector3d(0.01, -0.02, 0.0);
  const Eigen::Vector3d force = dissipate_created_energy(config, state, input);
  EXPECT_LT((force + config.max_damping_N_s_per_m * input.hand_mps).norm(), 1e-12);
  // A small debt is taken back within one tick: the power −f·v times dt is the debt.
  state.excess_J = -1e-7;
  const Eigen::Vector3d small = dissipate_created_energy(config, state, input);
  EXPECT_NEAR(-small.dot(input.hand_mps) * kTick_s, 1e-7, 1e-9);
}

TEST(Passivity, ForgivesAChangedSceneBoundsCreditAndForgetsDebt) {
  const SafetyConfig config;
  PassivityState state;
  PassivityInput input;
  input.touching = true;
  state.excess_J = -1e-3;
  input.forgive = true;
  dissipate_created_energy(config, state, input);
  EXPECT_EQ(state.excess_J, 0.0);
  input.forgive = false;
  state.excess_J = 1.0;
  dissipate_created_energy(config, state, input);
  EXPECT_EQ(state.excess_J, config.max_credit_J);
  input.touching = false;
  state.excess_J = -1e-3;
  input.hand_mps.x() = 0.1;
  EXPECT_EQ(dissipate_created_energy(config, state, input), Eigen::Vector3d::Zero());  // nothing drags in free space
  EXPECT_NEAR(state.excess_J, -1e-3 * std::exp(-kTick_s / config.debt_leak_s), 1e-15);
  for (int k = 0; k < 500; ++k) dissipate_created_energy(config, state, input);
  EXPECT_NEAR(state.excess_J, -1e-3 / std::exp(1.0), 1e-5);
}

}  // namespace
}  // namespace asperity
