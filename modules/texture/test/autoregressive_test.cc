#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/signal/spectrum.h"
#include "asperity/texture/autoregressive.h"
#include "asperity/texture/autoregressive_filter.h"
#include "asperity/texture/convert_rate.h"
#include "asperity/texture/evaluate_autoregressive.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

AutoregressiveModel random_model(Random& random, int order, int ma_order, double speed_mps, double force_N) {
  const auto lsf = [&](int count, double largest) {
    std::vector<double> k(static_cast<std::size_t>(count));
    for (double& km : k) km = random.uniform(-largest, largest);
    return count > 0 ? reflection_to_lsf(k) : std::vector<double>();
  };
  AutoregressiveModel model;
  model.speed_mps = speed_mps;
  model.force_N = force_N;
  model.ar_lsf_rad = lsf(order, order > 16 ? 0.6 : 0.9);
  model.ma_lsf_rad = lsf(ma_order, 0.6);
  model.gain = ma_order > 0 ? random.uniform(0.5, 2.0) : 1.0;
  model.variance = random.uniform(0.1, 2.0);
  return model;
}

AutoregressiveTexture random_texture(std::uint64_t seed, int models, int order, int ma_order) {
  Random random(seed);
  AutoregressiveTexture t;
  for (int i = 0; i < models; ++i)
    t.models.push_back(random_model(random, order, ma_order, random.uniform(0.02, 0.2), random.uniform(0.1, 3.0)));
  prepare_autoregressive(t, "test");
  return t;
}

TEST(Autoregressive, BlendsWithinTheTriangleAndAtTheBorder) {
  const auto t = random_texture(1, 30, 4, 0);
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double speed = random.uniform(0.0, 0.3);
    const double force = random.uniform(0.0, 4.0);
    const auto blend = blend_models(t, speed, force, static_cast<int>(random.uniform(-2.0, 60.0)));
    double sum = 0.0, blended_speed = 0.0, blended_force = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto& m = t.models[static_cast<std::size_t>(blend.model[j])];
      ASSERT_GE(blend.weight[j], 0.0);
      sum += blend.weight[j];
      blended_speed += blend.weight[j] * m.speed_mps;
      blended_force += blend.weight[j] * m.force_N;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    if (blend.triangle >= 0) {
      EXPECT_NEAR(blended_speed, speed, 1e-12);
      EXPECT_NEAR(blended_force, force, 1e-11);
    } else {
      // The nearest point: no model is nearer, and moving a little towards the query leaves the hull.
      const double du = (blended_speed - speed) / t.max_speed_mps, dv = (blended_force - force) / t.max_force_N;
      for (const auto& m : t.models)
        EXPECT_LE(std::hypot(du, dv),
                  std::hypot((m.speed_mps - speed) / t.max_speed_mps, (m.force_N - force) / t.max_force_N) + 1e-12);
      EXPECT_LT(blend_models(t, speed, force, -1).triangle, 0);
    }
  }
}

TEST(Autoregressive, OneModelAndModelsOnALine) {
  auto t = random_texture(1, 1, 3, 0);
  EXPECT_EQ(blend_models(t, 1.0, 1.0, 0).weight[0], 1.0);
  Random random(5);
  AutoregressiveTexture line;
  for (int i = 1; i <= 4; ++i) line.models.push_back(random_model(random, 3, 0, 0.05 * i, 1.0));
  prepare_autoregressive(line, "line");
  const auto blend = blend_models(line, 0.125, 2.0, 0);
  double speed = 0.0;
  for (std::size_t j = 0; j < 3; ++j)
    speed += blend.weight[j] * line.models[static_cast<std::size_t>(blend.model[j])].speed_mps;
  EXPECT_NEAR(speed, 0.125, 1e-12);
}

// What the triangulation promises: whatever speed and force come, the mixed filter is stable by Levinson's
// recursion, and its narrowest gap is no narrower than the models'.
TEST(Autoregressive, StableEverywhere) {
  for (const int order : {1, 2, 7, 16, 32}) {
    const auto t = random_texture(static_cast<std::uint64_t>(order), 24, order, 0);
    Random random(9);
    for (int i = 0; i < 4000; ++i) {
      double speed = random.uniform(-0.1, 0.4);
      double force = random.uniform(-1.0, 6.0);
      if (i % 50 == 0) speed = std::numeric_limits<double>::quiet_NaN();
      if (i % 51 == 0) force = std::numeric_limits<double>::infinity();
      if (i % 52 == 0) speed = 1e300;
      const auto filter = blended_filter(t, blend_models(t, speed, force, i));
      std::vector<double> a(static_cast<std::size_t>(order)), k(a.size());
      reflection_to_ar(std::span(filter.k).first(a.size()), a);
      ASSERT_TRUE(ar_to_reflection(a, k)) << order << " " << speed << " " << force;
      for (std::size_t m = 0; m < k.size(); ++m) ASSERT_LT(std::abs(filter.k[m]), 1.0);
      ASSERT_TRUE(std::isfinite(filter.sigma_mps2));
    }
  }
}

TEST(Autoregressive, BoundedHoweverFastSpeedAndForceChange) {
  const auto t = random_texture(77, 24, 20, 0);
  Random random(10);
  SeriesState state = start_series(1);
  double largest_sigma = 0.0, largest = 0.0, square = 0.0;
  constexpr int kCount = 50000;
  for (int i = 0; i < kCount; ++i) {
    const double speed = random.uniform(0.01, 0.25), force = random.uniform(0.1, 4.0);
    const double sigma = blended_filter(t, blend_models(t, speed, force, -1)).sigma_mps2;
    const double x = next_acceleration_mps2(t, state, speed, force, 1e-3);
    ASSERT_TRUE(std::isfinite(x));
    largest_sigma = std::max(largest_sigma, sigma);
    largest = std::max(largest, std::abs(x) / sigma);
    square += x * x / (sigma * sigma) / kCount;
  }
  // The lattice's states stay white under any rotation: unit variance at every step. The ratio is one sample
  // late, which costs nothing here as both are scaled by the step's own sigma. ±4 σ of the mean of
  // 50000 squares, were they independent: ±0.025; the filters' memory of some ten samples makes it ±0.08.
  EXPECT_NEAR(square, 1.0, 0.08);
  EXPECT_LT(largest, 6.5);
}

// Known spectrum: |gain B/A|² by direct evaluation against Welch's estimate of the series.
void expect_spectrum(int order, int ma_order) {
  const auto t = random_texture(static_cast<std::uint64_t>(100 + order), 1, order, ma_order);
  const auto& m = t.models[0];
  std::vector<double> a(m.ar_lsf_rad.size()), b(m.ma_lsf_rad.size());
  lsf_to_ar(m.ar_lsf_rad, a);
  lsf_to_ar(m.ma_lsf_rad, b);
  SeriesState state = start_series(5);
  std::vector<double> x(1 << 18);
  for (double& v : x) v = next_acceleration_mps2(t, state, 0.1, 1.0, 1e-3);
  const auto spectrum = welch(x, 1000.0, 512);
  double variance = 0.0;
  for (std::size_t first = 8; first + 16 < spectrum.frequency.size(); first += 16) {
    double measured = 0.0, expected = 0.0;
    for (std::size_t i = first; i < first + 16; ++i) {
      measured += spectrum.density[i];
      // Two-sided a radian to one-sided a hertz.
      expected += 2.0 / 1000.0 *
                  power_density(a, b, m.gain, m.variance, 2.0 * std::numbers::pi * spectrum.frequency[i] / 1000.0);
    }
    // 512 segments of 2 degrees, 16 bins, Hann: σ 1.5 % of the band; Hann leaks across a sharp peak.
    EXPECT_NEAR(measured / expected, 1.0, 0.07) << spectrum.frequency[first] << " Hz";
  }
  for (const double v : x) variance += v * v / static_cast<double>(x.size());
  EXPECT_NEAR(variance, m.sigma_mps2 * m.sigma_mps2, 0.05 * variance);
}

TEST(Autoregressive, HasTheModelsSpectrum) { expect_spectrum(6, 0); }
TEST(Autoregressive, HasTheModelsSpectrumWithANumerator) { expect_spectrum(5, 4); }

// What is promised of the mix: the barycentric mean of the models' output variances, whatever their gains and
// numerators, at any servo rate, with the conversion of the rate (what a renderer plays) and without.
void expect_mixed_variance(int order, int ma_order, double largest_gain) {
  auto t = random_texture(static_cast<std::uint64_t>(40 + order), 12, order, ma_order);
  Random random(3);
  for (auto& m : t.models) m.gain = random.uniform(0.2, largest_gain);
  prepare_autoregressive(t, "test");
  for (int point = 0; point < 2; ++point) {
    const double speed = random.uniform(0.05, 0.17), force = random.uniform(0.6, 2.5);
    const auto blend = blend_models(t, speed, force, -1);
    double expected = 0.0;
    for (std::size_t j = 0; j < 3; ++j)
      expected += blend.weight[j] * std::pow(t.models[static_cast<std::size_t>(blend.model[j])].sigma_mps2, 2);
    const auto variance = [&](const AutoregressiveTexture& played, double rate_Hz) {
      SeriesState state = start_series(static_cast<std::uint64_t>(point));
      const int count = 20000 * static_cast<int>(std::ceil(rate_Hz / 1000.0));
      double square = 0.0;
      for (int i = 0; i < count; ++i)
        square += std::pow(next_acceleration_mps2(played, state, speed, force, 1.0 / rate_Hz), 2) / count;
      return square;
    };
    // 20 s of a series whose memory is some ten samples of 1 kHz: the variance is known to 3 %. A
    // converted filter's spectrum differs from the mixed one, its variance does not.
    for (const double rate_Hz : {1000.0, 1001.0, 8000.0}) {
      EXPECT_NEAR(variance(convert_rate(t, {.rate_Hz = rate_Hz}), rate_Hz), expected, 0.1 * expected)
          << rate_Hz << " Hz, speed " << speed << " force " << force;
    }
    for (const double rate_Hz : {1001.0, 1500.0, 4000.0})
      EXPECT_NEAR(variance(t, rate_Hz), expected, 0.1 * expected) << rate_Hz << " Hz without conversion";
  }
}

TEST(Autoregressive, HasTheMixedVarianceAtEveryRate) { expect_mixed_variance(6, 0, 1.0); }
TEST(Autoregressive, HasTheMixedVarianceAtEveryRateOfGains) { expect_mixed_variance(6, 0, 3.0); }
TEST(Autoregressive, HasTheMixedVarianceAtEveryRateWithANumerator) { expect_mixed_variance(5, 4, 3.0); }

TEST(Autoregressive, FadesToNothingAtRest) {
  auto t = random_texture(3, 8, 4, 0);
  SeriesState state = start_series(1);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(next_acceleration_mps2(t, state, 0.0, 1.0, 1e-3), 0.0);
    EXPECT_EQ(next_acceleration_mps2(t, state, 0.1, 0.0, 1e-3), 0.0);
    EXPECT_EQ(next_acceleration_mps2(t, state, std::nan(""), 1.0, 1e-3), 0.0);
    const auto f = next_force(t, state, 1e-9, 1.0, 1e-3);
    EXPECT_LT(std::abs(f.normal_N) + std::abs(f.tangential_N), 1e-9);
  }
}

TEST(Autoregressive, ForceIsOffsetAndClamped) {
  auto t = random_texture(3, 1, 4, 0);
  t.tangential_ratio = 0.5;
  const double sigma_N = t.mass_kg * t.models[0].sigma_mps2;
  SeriesState state = start_series(1);
  double mean = 0.0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const auto f = next_force(t, state, 0.1, 1.0, 1e-3);
    ASSERT_GE(f.normal_N, 0.0);
    ASSERT_LE(f.normal_N, 6.0 * sigma_N * (1.0 + 1e-12));
    if (f.normal_N > 0.0 && f.normal_N < 6.0 * sigma_N) {
      ASSERT_NEAR(f.tangential_N, 0.5 * (f.normal_N - 3.0 * sigma_N), 1e-12);
    }
    mean += f.normal_N / kCount;
  }
  EXPECT_NEAR(mean, 3.0 * sigma_N, 0.1 * sigma_N);
}

TEST(Autoregressive, SameSeedSameSeriesAndStateIsCopied) {
  const auto t = random_texture(4, 8, 10, 3);
  SeriesState a = start_series(7), b = start_series(7), other = start_series(7, 1);
  int same = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = next_acceleration_mps2(t, a, 0.1, 1.0, 1e-3);
    ASSERT_EQ(x, next_acceleration_mps2(t, b, 0.1, 1.0, 1e-3));
    same += x == next_acceleration_mps2(t, other, 0.1, 1.0, 1e-3) ? 1 : 0;
  }
  EXPECT_LT(same, 3);
  SeriesState copy = a;
  EXPECT_EQ(next_acceleration_mps2(t, a, 0.1, 1.0, 1e-3), next_acceleration_mps2(t, copy, 0.1, 1.0, 1e-3));
}

TEST(Autoregressive, AnyStepIsHarmless) {
  const auto t = random_texture(4, 8, 10, 3);
  SeriesState state = start_series(7);
  for (const double dt_s : {0.0, 1e-9, 2.5e-4, 3.3e-3, 1.0, 1e300, -1.0, std::nan(""), double(INFINITY)})
    for (int i = 0; i < 50; ++i) EXPECT_TRUE(std::isfinite(next_acceleration_mps2(t, state, 0.1, 1.0, dt_s))) << dt_s;
}

TEST(Autoregressive, RefusesWhatIsNoModel) {
  const auto expect = [](auto change, const char* message) {
    auto t = random_texture(4, 3, 4, 2);
    change(t);
    EXPECT_THAT([&] { prepare_autoregressive(t, "file.xml"); }, ThrowsMessage<Error>(HasSubstr(message)));
  };
  expect([](auto& t) { t.models.clear(); }, "0 models");
  expect([](auto& t) { t.models[1].ar_lsf_rad.pop_back(); }, "model 2 has 3 AR frequencies where the first has 4");
  expect([](auto& t) { std::swap(t.models[2].ar_lsf_rad[0], t.models[2].ar_lsf_rad[1]); },
         "line spectral frequency 2 of model 3");
  expect([](auto& t) { t.models[0].ar_lsf_rad[3] = 3.2; }, "below π");
  expect([](auto& t) { t.models[0].ar_lsf_rad[0] = std::nan(""); }, "frequency 1 of model 1");
  expect([](auto& t) { t.models[0].ma_lsf_rad[0] = 0.0; }, "(MA)");
  expect([](auto& t) { t.models[0].variance = -1.0; }, "the variance -1");
  expect([](auto& t) { t.models[0].speed_mps = INFINITY; }, "the speed inf");
  expect([](auto& t) { t.rate_Hz = 0.0; }, "the rate 0");
  expect([](auto& t) { t.triangles = {{0, 1, 3}}; }, "a triangle of model 3; there are 3");
}

}  // namespace
}  // namespace asperity
