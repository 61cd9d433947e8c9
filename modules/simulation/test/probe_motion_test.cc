#include "asperity/simulation/probe_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/simulation/make_surface.h"

namespace asperity {
namespace {

// A hand without tremor or variation.
SimulationConfig calm(const char* surface, const char* material) {
  SimulationConfig config = make_simulation_config(surface, "open", material);
  HandConfig& hand = config.hand;
  hand.length_m = 0.01;
  hand.tremor_lateral_m = hand.tremor_normal_m = hand.tremor_along_m = hand.tremor_rotation_rad = 0.0;
  hand.force_variation = hand.speed_variation = hand.tilt_wander_rad = hand.lateral_wander_m = 0.0;
  return config;
}

SimulationConfig flat(const char* material) {
  SimulationConfig config = calm("sine", material);
  config.surface.amplitude_m = 0.0;
  return config;
}

std::vector<MotionState> run(const SimulationConfig& config) {
  const auto surface = make_surface(config.surface, 1);
  ProbeMotion motion(config, *surface);
  std::vector<MotionState> states;
  for (double t_s = 0.0; t_s < motion.duration_s(); t_s += config.step_s) states.push_back(motion.next());
  return states;
}

TEST(ProbeMotion, ForceAtRestIsTheSetPointAndIndentsByHookesLaw) {
  for (const char* material : {"stiff", "cork", "soft_rubber"}) {
    const SimulationConfig config = flat(material);
    const MotionState rest = run(config)[static_cast<std::size_t>(0.4 / config.step_s)];
    EXPECT_NEAR(rest.normal_force_N, 0.8, 1e-9) << material;
    EXPECT_NEAR(rest.height_m, -0.8 / config.contact.stiffness_N_per_m, 1e-12) << material;
    EXPECT_NEAR(rest.s_m, 0.0, 1e-12);
  }
}

TEST(ProbeMotion, SlidingFrictionIsCoulombsAndLagsTheHand) {
  SimulationConfig config = flat("stiff");
  config.contact.friction_viscous_s_per_m = 0.0;
  const auto states = run(config);
  const MotionState middle = states[states.size() / 2];
  // At 25 mm/s Stribeck's part has gone: exp(−25).
  EXPECT_NEAR(middle.friction_N, 0.18 * 0.8, 1e-4);
  const double pull_N = -middle.contact_force_world_N.x();
  EXPECT_NEAR(pull_N, 0.18 * 0.8, 1e-4);
}

TEST(ProbeMotion, TipFollowsAGentleRelief) {
  SimulationConfig config = calm("sine", "stiff");
  config.surface.amplitude_m = 20e-6;
  const auto states = run(config);
  const auto surface = make_surface(config.surface, 1);
  double worst_m = 0.0;
  for (const MotionState& state : states) {
    // The tip of radius r rolls r A k² / 2 = 3 % of the amplitude off a sine of 20 µm and 2 mm.
    const double relief_m = surface->height_m(state.s_m - 0.005, 0.0);
    worst_m = std::max(worst_m, std::abs(state.height_m + 0.8 / 2e5 - relief_m));
  }
  EXPECT_LT(worst_m, 1.5e-6);
}

TEST(ProbeMotion, TheTipIsAtRestWhenTimeBegins) {
  // Set down on a slope of 0.63, which friction of 0.22 does not hold.
  SimulationConfig config = calm("sine", "stiff");
  config.surface.amplitude_m = 0.2e-3;
  const auto states = run(config);
  const MotionState& later = states[static_cast<std::size_t>(0.4 / config.step_s)];
  EXPECT_GT(std::abs(states.front().s_m), 20e-6);  // it has slid before
  EXPECT_NEAR(later.s_m, states.front().s_m, 1e-6);
  EXPECT_NEAR(later.height_m, states.front().height_m, 1e-6);
}

TEST(ProbeMotion, LiftingOffLosesTheContact) {
  SimulationConfig config = flat("stiff");
  config.hand.lifts = 1;
  const auto states = run(config);
  const auto surface = make_surface(config.surface, 1);
  const double start_s = ProbeMotion(config, *surface).hand().lift_off_starts_s().front();
  double top_m = 0.0;
  for (const MotionState& state : states) {
    if (state.height_m > 0.1e-6) {
      EXPECT_EQ(state.normal_force_N, 0.0);
    }
    if (state.t_s > start_s && state.t_s < start_s + config.hand.lift_s) top_m = std::max(top_m, state.height_m);
  }
  EXPECT_NEAR(top_m, 3e-3, 0.5e-3);  // the hand's spring overshoots
  EXPECT_NEAR(states.back().normal_force_N, 0.8, 0.02);
}

TEST(ProbeMotion, RampGoesFromLightToFirm) {
  SimulationConfig config = flat("cork");
  config.hand.force = HandForce::kRamp;
  const auto states = run(config);
  EXPECT_NEAR(states[1000].normal_force_N, 0.3, 1e-6);
  EXPECT_NEAR(states.back().normal_force_N, 2.5, 0.01);
}

TEST(ProbeMotion, FirmPressingSmoothsSoftReliefOnly) {
  const auto amplitude = [](const char* material, double force_N) {
    SimulationConfig config = calm("sine", material);
    config.surface.pitch_m = 1e-3;
    config.surface.amplitude_m = 20e-6;
    config.hand.force_N = force_N;
    double low_m = 1.0;
    double high_m = -1.0;
    const auto states = run(config);
    for (std::size_t i = states.size() * 2 / 5; i < states.size() * 3 / 5; ++i) {
      low_m = std::min(low_m, states[i].height_m);
      high_m = std::max(high_m, states[i].height_m);
    }
    return 0.5 * (high_m - low_m);
  };
  EXPECT_GT(amplitude("stiff", 2.0) / amplitude("stiff", 0.4), 0.95);
  EXPECT_LT(amplitude("soft_rubber", 2.0) / amplitude("soft_rubber", 0.4), 0.6);
}

TEST(ProbeMotion, SlowStickyRubberSticksAndSlips) {
  SimulationConfig config = flat("soft_rubber");
  config.hand.speed_mps = 0.003;
  config.hand.length_m = 0.006;
  config.hand.force_N = 1.5;
  config.hand.tangential_damping_N_s_per_m = 2.0;
  config.contact.friction_static = 1.2;
  config.contact.friction_dynamic = 0.6;
  config.contact.friction_viscous_s_per_m = 0.0;
  const auto states = run(config);
  int stuck = 0;
  int slipping = 0;
  for (std::size_t i = states.size() / 3; i < states.size() * 2 / 3; ++i) {
    const double speed_mps = (states[i].s_m - states[i - 1].s_m) / config.step_s;
    stuck += speed_mps < 0.3e-3;
    slipping += speed_mps > 9e-3;
  }
  EXPECT_GT(stuck, static_cast<int>(states.size() / 60));
  EXPECT_GT(slipping, static_cast<int>(states.size() / 300));
}

}  // namespace
}  // namespace asperity
