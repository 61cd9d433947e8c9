#include "asperity/fidelity/score_realism.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/fidelity/estimate_hand.h"
#include "synthetic_stroke.h"

namespace asperity {
namespace {

using realism_test::ideal_sensors;
using realism_test::LinearStroke;
using realism_test::rough_stroke;

bool has(const Verdicts& verdicts, std::string_view code) {
  return std::any_of(verdicts.begin(), verdicts.end(), [&](const Verdict& verdict) { return verdict.code == code; });
}

// The oracle is the closed form of a linear oscillator, not the integration.
TEST(RenderStroke, FollowsTheLinearOscillatorOverASine) {
  for (const double stiffness : {2e5, 1e4, 2e3}) {
    for (const double cycles_per_m : {400.0, 1200.0, 2000.0}) {
      LinearStroke linear;
      linear.stiffness = stiffness;
      linear.waves = {{cycles_per_m, 3e-6, 0.4}};
      const RealStroke stroke = linear.measured("sine");
      const StrokeSignals signals = measure_stroke(stroke.result, stroke.calibration, "sine");
      const HandImpedance hand{linear.mass_kg, linear.hand_damping, linear.hand_stiffness, kNan, kNan, true};
      const RenderedStroke made = render_stroke(signals, grid_of(stroke.result.profile), linear.rendered().height_m,
                                                linear.rendered().contact, hand, ideal_sensors().probe, 0.15);
      // Complex amplitudes over the second half, a whole number of waves: the start has decayed (c_h / 2m is 30/s).
      const double omega = 2.0 * std::numbers::pi * cycles_per_m * linear.speed_mps;
      std::complex<double> made_a, true_a, made_f, true_f;
      for (std::size_t i = signals.size() / 2; i + 1 < signals.size(); ++i) {
        const LinearStroke::State state = linear.at(signals.t_s[i]);
        const std::complex<double> turn = std::polar(1.0, -omega * signals.t_s[i]);
        made_a += turn * made.accel_mps2[i];
        true_a += turn * state.accel_mps2;
        made_f += turn * (made.normal_N[i] - linear.force_N);
        true_f += turn * (state.force_N - linear.force_N);
      }
      // The step is a tenth of √(m/k): some per cent near resonance. N₀ has 5 % of the force at 0.4 cycles/mm.
      EXPECT_LT(std::abs(made_a / true_a - 1.0), 0.05) << stiffness << ' ' << cycles_per_m << ' ' << made_a / true_a;
      EXPECT_LT(std::abs(made_f / true_f - 1.0), 0.1) << stiffness << ' ' << cycles_per_m << ' ' << made_f / true_f;
    }
  }
}

TEST(RenderStroke, FrictionAndSlopeArePartOfTheReading) {
  LinearStroke linear;
  linear.waves = {{500.0, 10e-6, 0.0}};
  RealStroke stroke = linear.measured("tilted");
  // The probe leans by 0.3 rad along the travel: a·n = cos, a·t = sin.
  const Eigen::Quaterniond lean(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  for (auto& q : stroke.result.trajectory.motion.q_world_marker) q = lean;
  const StrokeSignals signals = measure_stroke(stroke.result, stroke.calibration, "tilted");
  EXPECT_NEAR(signals.reads_normal[500], std::cos(0.3), 1e-12);
  EXPECT_NEAR(signals.reads_tangential[500], std::sin(0.3), 1e-12);
  const RenderedStroke made = render_stroke(signals, grid_of(stroke.result.profile), linear.rendered().height_m,
                                            {linear.stiffness, 0.4}, HandImpedance{}, ideal_sensors().probe, 0.15);
  for (std::size_t i = 6000; i < 12000; i += 97) {
    EXPECT_NEAR(made.force_N[i], std::cos(0.3) * made.normal_N[i] - std::sin(0.3) * made.tangential_N[i], 1e-12);
    const double slope = (linear.relief_m(signals.s_m[i] + 1e-6) - linear.relief_m(signals.s_m[i] - 1e-6)) / 2e-6;
    // Linear interpolation between steps of 50 µs.
    EXPECT_NEAR(made.tangential_N[i] / made.normal_N[i], 0.4 + slope, 2e-3);
  }
}

TEST(EstimateHand, FindsMassDamperAndSpring) {
  const LinearStroke linear = rough_stroke();
  const RealStroke stroke = linear.measured("one");
  const StrokeSignals signals = measure_stroke(stroke.result, stroke.calibration, "one");
  const HandImpedance hand =
      estimate_hand(signals, grid_of(stroke.result.profile), 12.8e-3, 0.15, 4.0, ideal_sensors().probe);
  ASSERT_TRUE(hand.measured);
  // Readings 62 µm of path apart are splined; the finest wave has 8 of them.
  EXPECT_NEAR(hand.mass_kg, linear.mass_kg, 0.01 * linear.mass_kg);
  EXPECT_NEAR(hand.damping_N_s_per_m, linear.hand_damping, 0.05 * linear.hand_damping);
  EXPECT_NEAR(hand.stiffness_N_per_m, linear.hand_stiffness, 0.05 * linear.hand_stiffness);
  EXPECT_GT(hand.explained, 0.99);
}

TEST(EstimateHand, AForceThatIsNotOfTheMotionIsNotMeasured) {
  RealStroke stroke = rough_stroke().measured("one");
  Random random(3);
  for (double& f : stroke.result.trajectory.motion.force_N)
    if (std::isfinite(f)) f = 0.8 + 0.1 * random.normal();
  const StrokeSignals signals = measure_stroke(stroke.result, stroke.calibration, "one");
  VirtualProbeConfig config;
  config.hand_damping_N_s_per_m = 7.0;
  const HandImpedance hand = estimate_hand(signals, grid_of(stroke.result.profile), 12.8e-3, 0.15, 4.0, config);
  EXPECT_FALSE(hand.measured);
  EXPECT_EQ(hand.damping_N_s_per_m, 7.0);
}

std::string describe(const RealismScore& score) {
  const SignalAgreement &a = score.acceleration.rendered, &f = score.force.rendered;
  return testing::PrintToString(std::vector<double>{a.correlation, a.distance_dB, f.correlation, f.distance_dB,
                                                    score.hand.mass_kg, score.hand.damping_N_s_per_m,
                                                    score.hand.stiffness_N_per_m});
}

class ScoreRealism : public testing::Test {
 protected:
  LinearStroke linear = rough_stroke();
  RealStroke held = linear.measured("held back", 0.02, 1);
  std::vector<RealStroke> others{linear.measured("other", 0.02, 2)};

  RealismScore score(const RenderedRelief& relief) const {
    return score_realism(relief, held, others, ideal_sensors());
  }
};

TEST_F(ScoreRealism, TheTrueReliefIsNearTheCeiling) {
  const RealismScore result = score(linear.rendered());
  EXPECT_GT(result.score, 0.95) << describe(result);
  EXPECT_GT(result.ceiling, 0.95);
  EXPECT_NEAR(result.score, result.ceiling, 0.04);
  EXPECT_LE(result.low, result.score);
  EXPECT_GE(result.high, result.score);
  EXPECT_TRUE(result.alignment.agrees);
  EXPECT_TRUE(result.trustworthy);
  EXPECT_TRUE(std::isnan(result.friction.real));
  ASSERT_EQ(result.others.size(), 1u);
  EXPECT_NEAR(result.others[0].score, result.ceiling, 1e-12);
}

TEST_F(ScoreRealism, HeightsThatAreWrongLowerIt) {
  double before = score(linear.rendered()).score;
  for (const double factor : {1.2, 1.5, 2.0}) {
    const RealismScore result = score(linear.rendered(factor));
    EXPECT_LT(result.score, before) << factor;
    // Linear: every band is 20 log10(factor) too strong.
    EXPECT_NEAR(result.acceleration.rendered.distance_dB, 20.0 * std::log10(factor), 0.3) << factor;
    EXPECT_NEAR(result.acceleration.rendered.level_dB, 20.0 * std::log10(factor), 0.2) << factor;
    EXPECT_NEAR(result.force.rendered.level_dB, 20.0 * std::log10(factor), 0.3) << factor;
    before = result.score;
  }
  before = 1.0;
  for (const double factor : {0.8, 0.5, 0.25}) {
    const RealismScore result = score(linear.rendered(factor));
    EXPECT_LT(result.score, before) << factor;
    before = result.score;
  }
  EXPECT_LT(score(linear.rendered(-1.0)).score, 0.5);
}

TEST_F(ScoreRealism, SpringsThatAreWrongLowerIt) {
  double before = score(linear.rendered()).score;
  // Resonances at 318 Hz, then 142, 71, 32 and 22 Hz; the waves are 6 to 50 Hz.
  for (const double stiffness : {4e4, 1e4, 2e3, 1e3}) {
    RenderedRelief soft = linear.rendered();
    soft.contact.stiffness_N_per_m = stiffness;
    const RealismScore result = score(soft);
    EXPECT_LE(result.score, before) << stiffness;
    before = result.score;
  }
  EXPECT_LT(before, 0.4);
}

TEST_F(ScoreRealism, NoiseAndAFlatSurfaceScoreLow) {
  for (const std::uint64_t seed : {11u, 12u, 13u, 14u}) {
    LinearStroke noise = linear;
    noise.waves.clear();
    noise.add_waves(40, 0.25, 2.0, 20e-6, seed);
    const RealismScore result = score(noise.rendered());
    EXPECT_LT(result.score, 0.3) << seed;
    EXPECT_FALSE(result.alignment.agrees) << seed;
    EXPECT_TRUE(has(result.verdicts, "unlike_real"));
    EXPECT_TRUE(has(result.verdicts, "stroke_not_on_texture"));
    EXPECT_FALSE(result.trustworthy);
  }
}

TEST_F(ScoreRealism, AStrokeTravelledBackIsFound) {
  RenderedRelief back = linear.rendered();
  std::reverse(back.height_m.begin(), back.height_m.end());
  const RealismScore result = score(back);
  EXPECT_TRUE(result.alignment.reversed);
  EXPECT_NEAR(result.score, score(linear.rendered()).score, 0.02);
}

TEST_F(ScoreRealism, WithoutAnotherStrokeTheCeilingIsNotDetermined) {
  const RealismScore result = score_realism(linear.rendered(), held, {}, ideal_sensors());
  EXPECT_TRUE(std::isnan(result.ceiling));
  EXPECT_GT(result.score, 0.9);
  EXPECT_TRUE(has(result.verdicts, "ceiling_undetermined"));
}

TEST_F(ScoreRealism, StrokesOfAnotherLineAreNoCeiling) {
  LinearStroke elsewhere = linear;
  elsewhere.waves.clear();
  elsewhere.add_waves(40, 0.25, 2.0, 20e-6, 99);
  others = {elsewhere.measured("elsewhere", 0.02, 3)};
  const RealismScore result = score(linear.rendered());
  EXPECT_TRUE(has(result.verdicts, "no_common_line"));
  EXPECT_FALSE(result.trustworthy);
}

TEST_F(ScoreRealism, FrictionIsJudgedByThreeAxes) {
  const auto with_axes = [](RealStroke stroke, double friction) {
    TipMotion& motion = stroke.result.trajectory.motion;
    for (std::size_t i = 0; i < motion.size(); ++i)
      motion.force_world_N.emplace_back(-friction * motion.force_N[i], 0.0, motion.force_N[i]);
    return stroke;
  };
  held = with_axes(held, 0.2);
  others = {with_axes(others[0], 0.2)};
  RenderedRelief relief = linear.rendered();
  double before = 1.0;
  for (const double friction : {0.2, 0.3, 0.45, 0.9}) {
    relief.contact.friction = friction;
    const RealismScore result = score(relief);
    EXPECT_NEAR(result.friction.real, 0.2, 1e-9);
    // The relief's own push adds little: the tip presses no harder where it climbs a stiff relief slowly.
    EXPECT_NEAR(result.friction.rendered, friction, 0.03);
    EXPECT_LT(result.score, before) << friction;
    before = result.score;
  }
}

TEST_F(ScoreRealism, AStrokeThatIsTooShortIsRefused) {
  linear.length_m = 25e-3;
  EXPECT_THROW(score_realism(linear.rendered(), linear.measured("short"), {}, ideal_sensors()), Error);
}

}  // namespace
}  // namespace asperity
