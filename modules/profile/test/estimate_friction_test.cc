#include "asperity/profile/estimate_friction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr double kRate_Hz = 4000.0;

// A tip that slides along +x over z = height(x), pressed by `force_N`, under Coulomb's friction along the facet: with
// N_l on the facet and µ N_l against the motion, N = N_l (cos σ − µ sin σ) and T = N_l (sin σ + µ cos σ). The force
// passes a pole of `delay_s` and has noise.
struct Slide {
  TipMotion motion;
  BasePath path;
  std::vector<char> contact;

  struct Setting {
    std::function<double(double)> slope = [](double) { return 0.0; };       // over x
    std::function<double(double)> speed_mps = [](double) { return 0.03; };  // over t
    std::function<double(double)> friction = [](double) { return 0.3; };    // over the speed
    std::function<double(double)> force_N = [](double) { return 0.8; };     // on the facet, over t
    double duration_s = 4.0, delay_s = 0.0, noise_N = 0.005;
  };

  explicit Slide(const Setting& setting, unsigned seed = 1) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto n = static_cast<int>(setting.duration_s * kRate_Hz);
    double x_m = 0.0;
    Vector3d late_N = Vector3d::Zero();
    for (int i = 0; i < n; ++i) {
      const double t_s = i / kRate_Hz, speed_mps = setting.speed_mps(t_s), slope = setting.slope(x_m);
      const double sigma = std::atan(slope), mu = setting.friction(speed_mps), on_facet_N = setting.force_N(t_s);
      const Vector3d force_N(-on_facet_N * (std::sin(sigma) + mu * std::cos(sigma)), 0.0,
                             on_facet_N * (std::cos(sigma) - mu * std::sin(sigma)));
      const double share = setting.delay_s > 0.0 && i > 0 ? -std::expm1(-1.0 / kRate_Hz / setting.delay_s) : 1.0;
      late_N += share * (force_N - late_N);
      motion.t_ns.push_back(static_cast<std::int64_t>(std::llround(t_s * 1e9)));
      motion.p_world_tip_m.emplace_back(x_m, 0.0, 0.0);
      motion.v_world_tip_mps.emplace_back(speed_mps, 0.0, slope * speed_mps);
      motion.force_world_N.push_back(late_N +
                                     setting.noise_N * Vector3d(normal(random), normal(random), normal(random)));
      path.p_world_m.emplace_back(x_m, 0.0, 0.0);
      path.n_world.emplace_back(0.0, 0.0, 1.0);
      path.s_m.push_back(x_m);
      contact.push_back(1);
      x_m += speed_mps / kRate_Hz;
    }
  }

  FrictionEstimate estimate(const FrictionConfig& config = {}) const {
    return estimate_friction(motion, path, contact, config);
  }
};

double wave(double x_m) { return 0.25 * std::sin(2.0 * std::numbers::pi * x_m / 1.7e-3); }

TEST(EstimateFriction, ASlidingTipOnAFlatPlaneGivesTheCoefficient) {
  for (const double mu : {0.05, 0.3, 0.8}) {
    Slide::Setting setting;
    setting.friction = [mu](double) { return mu; };
    const FrictionEstimate found = Slide(setting).estimate();
    EXPECT_TRUE(found.determined) << found.verdict;
    EXPECT_NEAR(found.coefficient, mu, 1e-3);  // 5 mN of white noise on 0.8 N, 16,000 samples
    EXPECT_LE(found.low, mu);
    EXPECT_GE(found.high, mu);
    EXPECT_FALSE(found.stribeck);
    EXPECT_EQ(found.sticks, 0U);
  }
}

TEST(EstimateFriction, ARoughSurfaceAndASlowSensorDoNotRaiseIt) {
  for (const double mu : {0.1, 0.4}) {
    Slide::Setting setting;
    setting.slope = wave;
    setting.friction = [mu](double) { return mu; };
    setting.delay_s = 1.6e-3;  // a pole of 100 Hz
    // The tip presses harder where it climbs: by the sums of the forces friction would be larger.
    setting.force_N = [](double t_s) { return 0.8 + 0.5 * wave(0.03 * t_s); };
    const Slide slide(setting);
    double along_N = 0.0, normal_N = 0.0;
    for (const Vector3d& force_N : slide.motion.force_world_N) {
      along_N -= force_N.x();
      normal_N += force_N.z();
    }
    const FrictionEstimate found = slide.estimate();
    EXPECT_GT(along_N / normal_N, mu + 0.01);
    EXPECT_TRUE(found.determined) << found.verdict;
    // The pole acts on the forces, the estimate's on the slope: they differ in second order of the slope, 0.25².
    EXPECT_NEAR(found.coefficient, mu, 0.01);
    EXPECT_NEAR(found.sensor_delay_s, 1.6e-3, 0.5e-3);
    EXPECT_LE(found.low, mu);
    EXPECT_GE(found.high, mu);
  }
}

TEST(EstimateFriction, StribecksLawIsFoundWhereTheSpeedsShowIt) {
  Slide::Setting setting;
  setting.duration_s = 8.0;
  setting.speed_mps = [](double t_s) { return 0.006 + 0.006 * t_s; };
  setting.friction = [](double v_mps) { return 0.2 + 0.15 * std::exp(-v_mps / 0.012); };
  const FrictionEstimate found = Slide(setting).estimate();
  ASSERT_TRUE(found.stribeck);
  EXPECT_NEAR(found.stribeck->sliding, 0.2, 0.01);
  EXPECT_NEAR(found.stribeck->at_rest, 0.35, 0.03);
  EXPECT_NEAR(found.stribeck->speed_mps, 0.012, 0.003);
  EXPECT_LT(found.per_mps, 0.0);
  // Without a stick the law gives the ratio to the coefficient that is rendered.
  EXPECT_TRUE(std::isnan(found.breakaway));
  EXPECT_NEAR(found.static_ratio, 0.35 / found.coefficient, 0.15);
}

// Any law goes through three points: what is left is 0, and neither an error nor evidence.
TEST(EstimateFriction, ThreeWindowsShowNoLawAndNoErrorOfASlope) {
  Slide::Setting setting;
  setting.duration_s = 0.3;
  setting.speed_mps = [](double t_s) { return 0.006 + 0.18 * t_s; };
  setting.friction = [](double v_mps) { return 0.3 - 0.2 * v_mps; };
  FrictionConfig config;
  config.min_windows = 3;
  const FrictionEstimate found = Slide(setting).estimate(config);
  ASSERT_EQ(found.windows.size(), 3U);
  EXPECT_FALSE(found.stribeck);
  EXPECT_TRUE(std::isnan(found.per_mps_stderr)) << found.per_mps << " ± " << found.per_mps_stderr;
}

TEST(EstimateFriction, SticksBetweenSlidesAreCountedAndGiveTheBreakaway) {
  // 0.1 s held, the force along the surface rising to 0.5 of the normal one, then 0.1 s of sliding at µ = 0.3.
  constexpr long kHeld = 400, kPeriod = 800;  // samples
  Slide::Setting setting;
  setting.speed_mps = [](double t_s) { return std::lround(t_s * kRate_Hz) % kPeriod < kHeld ? 0.0 : 0.04; };
  Slide slide(setting);
  for (std::size_t i = 0; i < slide.motion.size(); ++i) {
    const auto held = static_cast<long>(i) % kPeriod;
    if (held < kHeld) slide.motion.force_world_N[i].x() = -0.8 * (0.3 + 0.2 * static_cast<double>(held) / kHeld);
  }
  const FrictionEstimate found = slide.estimate();
  EXPECT_NEAR(static_cast<double>(found.sticks), 19.0, 1.0);  // 20 of 4 s, the first begins before any sliding
  EXPECT_NEAR(found.stuck_share, 0.475, 0.02);
  EXPECT_NEAR(found.breakaway, 0.5, 0.01);
  EXPECT_NEAR(found.coefficient, 0.3, 0.01);
  EXPECT_NEAR(found.static_ratio, 0.5 / 0.3, 0.06);
  EXPECT_LT(found.static_ratio_stderr, 0.2);
}

TEST(EstimateFriction, EdgesLeaveItUndetermined) {
  // A tip that hits edges: short, hard blows against the motion that no facet under it explains.
  Slide::Setting setting;
  Slide slide(setting);
  for (std::size_t i = 0; i < slide.motion.size(); ++i) {
    if (i % 100 < 40) slide.motion.force_world_N[i] = Vector3d(-1.5, 0.0, 0.8);
  }
  const FrictionEstimate found = slide.estimate();
  EXPECT_FALSE(found.determined);
  EXPECT_GT(found.standard_error, 0.2);
  EXPECT_THAT(found.verdict, testing::HasSubstr("edges"));
}

TEST(EstimateFriction, WithoutThreeAxesOrSlidingThereIsNone) {
  Slide::Setting setting;
  Slide one_axis(setting);
  one_axis.motion.force_world_N.clear();
  EXPECT_THAT(one_axis.estimate().verdict, testing::HasSubstr("three axes"));
  EXPECT_TRUE(std::isnan(one_axis.estimate().coefficient));

  Slide in_air(setting);
  std::fill(in_air.contact.begin(), in_air.contact.end(), char{0});
  EXPECT_FALSE(in_air.estimate().determined);
  EXPECT_THAT(in_air.estimate().verdict, testing::HasSubstr("not determined"));

  setting.speed_mps = [](double) { return 1e-4; };
  EXPECT_FALSE(Slide(setting).estimate().determined);

  Slide wrong(setting);
  wrong.contact.pop_back();
  EXPECT_THROW(wrong.estimate(), Error);
}

TEST(EstimateFriction, NoiseAloneGivesNoCoefficient) {
  Slide::Setting setting;
  Slide noise(setting);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (Vector3d& force_N : noise.motion.force_world_N) force_N = 0.3 * Vector3d(normal(random), 0.0, normal(random));
  const FrictionEstimate found = noise.estimate();
  EXPECT_FALSE(found.determined && found.low > 0.0) << found.coefficient << " ± " << found.standard_error;
}

}  // namespace
}  // namespace asperity
