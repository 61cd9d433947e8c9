#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/texture/evaluate_decaying_sinusoids.h"
#include "asperity/texture/fit_decaying_sinusoids.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

constexpr DecayingSinusoids kTruth{.a_per_s = 120.0, .b_per_kg = 4.0, .decay_per_s = 90.0, .omega_rad_per_s = 2000.0};

double analytic(const DecayingSinusoids& t, double v, double f, double time_s) {
  return (t.a_per_s * v + t.b_per_kg * f) * std::exp(-t.decay_per_s * time_s) * std::sin(t.omega_rad_per_s * time_s);
}

TEST(DecayingSinusoids, OneTapIsTheFormula) {
  SeriesState state = start_series(1);
  start_tap(kTruth, state, 0.2, 1.5);
  for (int i = 1; i < 400; ++i)
    ASSERT_NEAR(next_acceleration_mps2(kTruth, state, 0.0, 0.0, 2.5e-4), analytic(kTruth, 0.2, 1.5, i * 2.5e-4), 1e-10);
}

TEST(DecayingSinusoids, AnyNumberOfTapsOverlap) {
  SeriesState state = start_series(1);
  for (int i = 0; i < 300; ++i) {
    double expected = 0.0;
    for (int tap = 0; tap <= 30 && 7 * tap < i; ++tap)
      expected += analytic(kTruth, 0.1 * tap, 1.0, (i - 7 * tap) * 1e-3);
    if (i > 0) {
      ASSERT_NEAR(next_acceleration_mps2(kTruth, state, 0.0, 0.0, 1e-3), expected, 1e-9) << i;
    }
    if (i % 7 == 0 && i <= 210) start_tap(kTruth, state, 0.1 * (i / 7), 1.0);
  }
}

TEST(DecayingSinusoids, EdgesComeEveryPitch) {
  DecayingSinusoids t = kTruth;
  t.pitch_m = 1e-3;
  SeriesState state = start_series(1);
  std::vector<int> starts;
  double last = 0.0;
  for (int i = 0; i < 2010; ++i) {
    next_acceleration_mps2(t, state, 0.05, 1.0, 2.5e-4);  // 12.5 µm a step: 80 steps a pitch
    const double energy = std::hypot(state.ringing[0], state.ringing[1]);
    if (energy > last) starts.push_back(i);
    last = energy;
  }
  ASSERT_EQ(starts.size(), 25u);
  for (std::size_t i = 1; i < starts.size(); ++i) EXPECT_NEAR(starts[i] - starts[i - 1], 80, 1);
  const auto force = next_force(t, state, 0.05, 1.0, 2.5e-4);
  EXPECT_EQ(force.normal_N, t.mass_kg * state.ringing[1]);
  for (const double bad : {std::nan(""), double(INFINITY), -1.0, 1e300})
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(std::isfinite(next_acceleration_mps2(t, state, bad, bad, 1e-3)));
}

struct Taps {
  std::vector<std::vector<double>> samples;
  std::vector<TapRecording> recordings;
};

Taps make_taps(const std::vector<std::pair<double, double>>& speed_force, double noise, double rate_Hz) {
  Taps taps;
  Random random(11);
  for (const auto& [v, f] : speed_force) {
    std::vector<double> x(200);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = analytic(kTruth, v, f, static_cast<double>(i) / rate_Hz) + noise * random.normal();
    taps.samples.push_back(std::move(x));
  }
  for (std::size_t i = 0; i < speed_force.size(); ++i)
    taps.recordings.push_back({taps.samples[i], speed_force[i].first, speed_force[i].second});
  return taps;
}

const std::vector<std::pair<double, double>> kTaps{{0.05, 0.5}, {0.1, 0.4}, {0.2, 2.0}, {0.3, 0.2}, {0.15, 1.0}};

TEST(FitDecayingSinusoids, ExactWithoutNoise) {
  const auto taps = make_taps(kTaps, 0.0, 4000.0);
  const auto fit = fit_decaying_sinusoids(taps.recordings, {.rate_Hz = 4000.0});
  EXPECT_TRUE(fit.converged);
  EXPECT_TRUE(fit.speed_and_force_determined);
  EXPECT_THAT(fit.problems, IsEmpty());
  EXPECT_NEAR(fit.texture.a_per_s, 120.0, 1e-6);
  EXPECT_NEAR(fit.texture.b_per_kg, 4.0, 1e-7);
  EXPECT_NEAR(fit.texture.decay_per_s, 90.0, 1e-6);
  EXPECT_NEAR(fit.texture.omega_rad_per_s, 2000.0, 1e-6);
  EXPECT_LT(fit.rms_error_mps2, 1e-9);
  EXPECT_NEAR(fit.amplitude_mps2[2], 120.0 * 0.2 + 4.0 * 2.0, 1e-7);
}

TEST(FitDecayingSinusoids, AsGoodAsTheNoiseAllows) {
  constexpr double kNoise = 1.0;
  const auto taps = make_taps(kTaps, kNoise, 4000.0);
  const auto fit = fit_decaying_sinusoids(taps.recordings, {.rate_Hz = 4000.0});
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(fit.rms_error_mps2, kNoise, 5.0 * kNoise / std::sqrt(2.0 * 1000.0));
  // A decaying tone's frequency is known to σ_ω = 2B/(A/noise) sqrt(B/rate·…): for ΣA² = 3·10³ about 1.3 rad/s
  // and the same for B; five of them.
  EXPECT_NEAR(fit.texture.omega_rad_per_s, 2000.0, 6.5);
  EXPECT_NEAR(fit.texture.decay_per_s, 90.0, 6.5);
  EXPECT_NEAR(fit.texture.a_per_s, 120.0, 12.0);
  EXPECT_NEAR(fit.texture.b_per_kg, 4.0, 1.8);
}

TEST(FitDecayingSinusoids, SaysWhatTapsCannotTell) {
  const auto taps = make_taps({{0.1, 1.0}, {0.2, 2.0}}, 0.0, 4000.0);
  const auto fit = fit_decaying_sinusoids(taps.recordings, {.rate_Hz = 4000.0});
  EXPECT_FALSE(fit.speed_and_force_determined);
  ASSERT_EQ(fit.problems.size(), 1u);
  EXPECT_NEAR(fit.texture.a_per_s * 0.2 + fit.texture.b_per_kg * 2.0, 120.0 * 0.2 + 4.0 * 2.0, 1e-6);
}

TEST(FitDecayingSinusoids, RefusesWhatIsNoTap) {
  const std::vector<double> short_tap(15, 1.0), silent(32, 0.0), bad(32, std::nan(""));
  std::vector<double> decay(64);
  for (std::size_t i = 0; i < decay.size(); ++i) decay[i] = std::exp(-0.1 * static_cast<double>(i));
  EXPECT_THAT([] { fit_decaying_sinusoids({}); }, ThrowsMessage<Error>(HasSubstr("no taps")));
  EXPECT_THAT([&] { fit_decaying_sinusoids({{short_tap, 1.0, 1.0}}); }, ThrowsMessage<Error>(HasSubstr("15 samples")));
  EXPECT_THAT([&] { fit_decaying_sinusoids({{silent, 1.0, 1.0}}); }, ThrowsMessage<Error>(HasSubstr("silent")));
  EXPECT_THAT([&] { fit_decaying_sinusoids({{bad, 1.0, 1.0}}); }, ThrowsMessage<Error>(HasSubstr("not finite")));
  EXPECT_THAT([&] { fit_decaying_sinusoids({{decay, -1.0, 1.0}}); }, ThrowsMessage<Error>(HasSubstr("speed -1")));
  EXPECT_THAT(
      [&] {
        fit_decaying_sinusoids({{decay, 1.0, 1.0}});
      },
      ThrowsMessage<Error>(HasSubstr("do not oscillate")));
}

}  // namespace
}  // namespace asperity
