// The models that have a past: statistics along the way, loads, taps.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "asperity/render/texture_force.h"
#include "asperity/texture/autoregressive_filter.h"

namespace asperity {
namespace {

TextureTouch stroke(double speed_mps, double contact_N, double dt_s) {
  TextureTouch touch;
  touch.x_gradient = Eigen::Vector3d::UnitX();
  touch.y_gradient = Eigen::Vector3d::UnitY();
  touch.stiffness_N_per_m = 1000.0;
  touch.contact_N = contact_N;
  touch.z_m = -contact_N / 1000.0;
  touch.v_tangential_mps = Eigen::Vector3d(speed_mps, 0.0, 0.0);
  touch.dt_s = dt_s;
  return touch;
}

Texture stochastic(double correlation_length_m) {
  Texture texture;
  texture.model =
      StochasticTexture{.sigma_m = 2e-5, .correlation_length_m = correlation_length_m, .tangential_ratio = 0.3};
  return texture;
}

Texture vibration(double sigma_mps2) {
  AutoregressiveTexture t;
  for (const double speed_mps : {0.05, 0.2}) {
    for (const double force_N : {0.5, 2.0}) {
      const std::vector<double> k{-0.9, 0.5};
      // 1/((1 − 0.81)(1 − 0.25)) is the gain of this filter.
      t.models.push_back(
          {speed_mps, force_N, reflection_to_lsf(k), {}, 1.0, sigma_mps2 * sigma_mps2 * (1.0 - 0.81) * (1.0 - 0.25)});
    }
  }
  prepare_autoregressive(t, "test");
  Texture texture;
  texture.model = t;
  return texture;
}

// Mean, spread and covariance over `lag_m` of the normal force on a straight stroke.
struct Statistics {
  double mean_N = 0.0;
  double sigma_N = 0.0;
  double correlation = 0.0;
};

Statistics along_a_stroke(const RenderTexture& texture, double speed_mps, double dt_s, double lag_m, double length_m) {
  TextureState state;
  std::vector<double> force_N;
  const TextureTouch touch = stroke(speed_mps, 1.0, dt_s);
  const auto count = static_cast<std::size_t>(length_m / (speed_mps * dt_s));
  for (std::size_t i = 0; i < count; ++i) force_N.push_back(texture_force(texture, state, touch).force_N.z());
  Statistics s;
  for (const double f : force_N) s.mean_N += f / static_cast<double>(count);
  for (const double f : force_N) s.sigma_N += (f - s.mean_N) * (f - s.mean_N) / static_cast<double>(count);
  s.sigma_N = std::sqrt(s.sigma_N);
  const auto lag = static_cast<std::size_t>(std::lround(lag_m / (speed_mps * dt_s)));
  for (std::size_t i = lag; i < count; ++i)
    s.correlation += (force_N[i] - s.mean_N) * (force_N[i - lag] - s.mean_N) / static_cast<double>(count - lag);
  s.correlation /= s.sigma_N * s.sigma_N;
  return s;
}

// Two impulses blended linearly at constant variance, at half their distance: the mean over the place u of
// E[z(u) z(u + ½)], w(u) = (1 − u, u) normalised.
double expected_correlation() {
  double sum = 0.0;
  constexpr int kPlaces = 4000;
  for (int i = 0; i < kPlaces; ++i) {
    const double u = (i + 0.5) / kPlaces;
    const double n0 = std::hypot(1.0 - u, u);
    const double w = u < 0.5 ? u + 0.5 : u - 0.5;
    const double n1 = std::hypot(1.0 - w, w);
    sum += u < 0.5 ? ((1.0 - u) * (1.0 - w) + u * w) / (n0 * n1) : u * (1.0 - w) / (n0 * n1);
  }
  return sum / kPlaces;
}

TEST(StochasticForce, IsTheSameByTheMetreAtEverySpeedAndRate) {
  constexpr double kCorrelationLength_m = 4e-4;
  const RenderTexture texture = make_render_texture(stochastic(kCorrelationLength_m), {});
  EXPECT_EQ(texture.model, kForceModelOf<StochasticTexture>);
  EXPECT_NEAR(texture.highest_m, 2.0 * 3.0 * 2e-5, 1e-15);
  const double sigma_N = 300.0 * 2e-5;
  for (const double speed_mps : {0.025, 0.1}) {
    for (const double dt_s : {1e-3, 2.5e-4}) {
      // 20000 impulses: standard errors of 0.5 % of the spread, 0.7 % of σ and of the correlation.
      const Statistics s =
          along_a_stroke(texture, speed_mps, dt_s, 0.5 * kCorrelationLength_m, 2e4 * kCorrelationLength_m);
      EXPECT_NEAR(s.mean_N, 3.0 * sigma_N, 0.03 * sigma_N) << speed_mps << ' ' << dt_s;
      EXPECT_NEAR(s.sigma_N, sigma_N, 0.03 * sigma_N) << speed_mps << ' ' << dt_s;
      EXPECT_NEAR(s.correlation, expected_correlation(), 0.03) << speed_mps << ' ' << dt_s;
    }
  }
}

TEST(StochasticForce, WithoutACorrelationLengthIsWhatTheOriginalDoesAtOneKilohertz) {
  const RenderTexture texture = make_render_texture(stochastic(0.0), {});
  EXPECT_DOUBLE_EQ(std::get<StochasticTexture>(texture.texture.model).correlation_length_m, 0.05e-3);
}

TEST(StochasticForce, OfAHeightFieldHasItsSpread) {
  Texture sine;
  sine.model = Fourier1d{5.0, {0.0}, {1e-4}, 0.0};
  const RenderTexture texture = make_render_texture(sine, {.model = kForceModelOf<StochasticTexture>});
  const auto& series = std::get<StochasticTexture>(*texture.series_of_heights);
  EXPECT_NEAR(series.sigma_m, 1e-4 / std::numbers::sqrt2, 1e-7);
  // cos(ωx) falls below 1/e at arccos(1/e)/ω.
  EXPECT_NEAR(series.correlation_length_m, 5e-3 * std::acos(std::exp(-1.0)) / (2.0 * std::numbers::pi), 1e-4);
  const Statistics s = along_a_stroke(texture, 0.1, 1e-3, 1e-4, 10.0);
  EXPECT_NEAR(s.sigma_N, 1000.0 * series.sigma_m, 0.05 * 1000.0 * series.sigma_m);
}

// As friction: an impulse above the mean brakes, one below it yields.
TEST(StochasticForce, TangentialPartIsItsRatioOfTheNormalOneAgainstTheMotion) {
  const RenderTexture texture = make_render_texture(stochastic(1e-4), {});
  TextureState state;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d f = texture_force(texture, state, stroke(0.1, 1.0, 1e-3)).force_N;
    EXPECT_NEAR(f.x(), -0.3 * (f.z() - 300.0 * 3.0 * 2e-5), 1e-12);
    EXPECT_EQ(f.y(), 0.0);
  }
}

TEST(AutoregressiveForce, HasMeanZeroAndTheModelsSpread) {
  const RenderTexture texture = make_render_texture(vibration(2.0), {});
  EXPECT_EQ(texture.highest_m, 0.0);
  const Statistics s = along_a_stroke(texture, 0.1, 1e-3, 1e-4, 20.0);
  // 0.05 kg · 2 m/s²; 200 s of it, correlated over 20 ms: 10⁴ independent samples.
  EXPECT_NEAR(s.mean_N, 0.0, 0.04 * 0.1);
  EXPECT_NEAR(s.sigma_N, 0.1, 0.04 * 0.1);
}

// A texture does not change the load at which a surface is touched: no step, no pull, no push of its own.
TEST(AutoregressiveForce, IsNeverStrongerThanItsLoad) {
  const RenderTexture texture = make_render_texture(vibration(20.0), {});
  TextureState state;
  for (int i = 0; i < 20000; ++i) {
    const double load_N = 1e-4 * (i % 2000);
    const TextureForce force = texture_force(texture, state, stroke(0.1, load_N, 1e-3));
    EXPECT_LE(std::abs(force.force_N.z()), load_N);
  }
}

TEST(AutoregressiveForce, IsConvertedToTheServosRate) {
  RenderTextureConfig config;
  config.rate_Hz = 4000.0;
  const RenderTexture texture = make_render_texture(vibration(2.0), config);
  EXPECT_EQ(std::get<AutoregressiveTexture>(texture.texture.model).rate_Hz, 4000.0);
}

TEST(AutoregressiveForce, TangentialPartOpposesTheMotion) {
  Texture source = vibration(2.0);
  std::get<AutoregressiveTexture>(source.model).tangential_ratio = 0.4;
  const RenderTexture texture = make_render_texture(source, {});
  TextureState state;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d f = texture_force(texture, state, stroke(0.1, 1.0, 1e-3)).force_N;
    EXPECT_NEAR(f.x(), -0.4 * f.z(), 1e-12);
  }
}

DecayingSinusoids ringing() {
  return {.a_per_s = 200.0, .decay_per_s = 80.0, .omega_rad_per_s = 2.0 * std::numbers::pi * 150.0, .mass_kg = 0.05};
}

TEST(RingingForce, BeginsAtContactByTheSpeedOfApproach) {
  Texture texture;
  texture.model = ringing();
  const RenderTexture rendered = make_render_texture(texture, {});
  TextureState state;
  constexpr double kRate_Hz = 1000.0;
  for (const double approach_mps : {0.1, 0.05}) {
    no_texture_force(state, false, 1.0 / kRate_Hz);
    for (int i = 0; i < 60; ++i) {
      TextureTouch touch = stroke(0.0, 2.0, 1.0 / kRate_Hz);
      touch.approach_mps = approach_mps;
      const double t_s = i / kRate_Hz;
      const double expected_N =
          0.05 * 200.0 * approach_mps * std::exp(-80.0 * t_s) * std::sin(2.0 * std::numbers::pi * 150.0 * t_s);
      EXPECT_NEAR(texture_force(rendered, state, touch).force_N.z(), expected_N, 1e-9) << i;
    }
  }
}

TEST(RingingForce, DoesNotPullAndEndsWithTheLoad) {
  Texture texture;
  texture.model = ringing();
  const RenderTexture rendered = make_render_texture(texture, {});
  TextureState state;
  no_texture_force(state, false, 1e-3);
  for (int i = 0; i < 200; ++i) {
    const double load_N = std::max(0.2 - 1e-3 * i, 0.0);
    TextureTouch touch = stroke(0.0, load_N, 1e-3);
    touch.approach_mps = 0.3;
    const double force_N = texture_force(rendered, state, touch).force_N.z();
    EXPECT_GE(force_N, -load_N);
    // Under a ringing of at most 3 N, 3 (load / 0.05 N)² of it.
    EXPECT_LE(std::abs(force_N), 3.0 * 3.0 * std::pow(load_N / 0.05, 2));
  }
}

}  // namespace
}  // namespace asperity
