#include "asperity/texture/fit_autoregressive.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/texture/autoregressive_filter.h"
#include "asperity/texture/evaluate_autoregressive.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Series {
  std::vector<double> acceleration_mps2, speed_mps, force_N;
  SeriesRecording recording() const { return {acceleration_mps2, speed_mps, force_N, 1000.0}; }
};

// A resonance whose frequency rises with speed, whose damping rises and whose strength rises with force and speed,
// directly recursed: nothing of the code under test.
struct Truth {
  double pole_radius, pole_rad, sigma;
  Truth(double speed_mps, double force_N)
      : pole_radius(0.9 - 0.1 * force_N / 2.0),
        pole_rad(2.0 * std::numbers::pi * (0.08 + 0.12 * speed_mps / 0.1)),
        sigma(0.2 + 3.0 * speed_mps + 0.3 * force_N) {}
};

Series synthetic(double duration_s, std::uint64_t seed) {
  Random random(seed);
  Series s;
  double x1 = 0.0, x2 = 0.0;
  const int count = static_cast<int>(duration_s * 1000.0);
  for (int i = 0; i < count; ++i) {
    const double t = i * 1e-3;
    const double speed = 0.06 + 0.04 * std::sin(2.0 * std::numbers::pi * t / 5.0);
    const double force = 1.0 + 0.7 * std::sin(2.0 * std::numbers::pi * t / 7.3 + 1.0);
    const Truth truth(speed, force);
    const double x = 2.0 * truth.pole_radius * std::cos(truth.pole_rad) * x1 -
                     truth.pole_radius * truth.pole_radius * x2 + truth.sigma * random.normal();
    x2 = x1;
    x1 = x;
    s.acceleration_mps2.push_back(x);
    s.speed_mps.push_back(speed);
    s.force_N.push_back(force);
  }
  return s;
}

TEST(FitAutoregressive, FindsAKnownStationaryProcess) {
  Random random(1);
  Series s;
  // Poles at 0.95 e^(±0.6i) and 0.8 e^(±1.9i).
  const std::vector<double> a{-2.0 * 0.95 * std::cos(0.6), 0.9025};
  double x1 = 0.0, x2 = 0.0;
  constexpr int kCount = 40000;
  for (int i = 0; i < kCount; ++i) {
    const double x = -a[0] * x1 - a[1] * x2 + 0.5 * random.normal();
    x2 = x1;
    x1 = x;
    s.acceleration_mps2.push_back(x);
    s.speed_mps.push_back(0.05);
    s.force_N.push_back(1.0);
  }
  const auto fit = fit_autoregressive(s.recording(), {.high_pass_Hz = 0.0, .min_order = 1, .max_order = 12});
  EXPECT_EQ(fit.order, 2);
  ASSERT_EQ(fit.texture.models.size(), 1u);
  const auto& model = fit.texture.models[0];
  std::vector<double> found(2);
  lsf_to_ar(model.ar_lsf_rad, found);
  // The estimates' standard deviation is sqrt((1 − a2²)/N) = 0.0022; four of them.
  EXPECT_NEAR(found[0], a[0], 0.009);
  EXPECT_NEAR(found[1], a[1], 0.009);
  EXPECT_NEAR(model.variance, 0.25, 4.0 * 0.25 * std::sqrt(2.0 / kCount));
  EXPECT_LT(std::abs(fit.held_out.variance_error), 0.1);
}

// Issue: "the autoregressive model's synthesised variance and spectrum match a held-out half within 10 %".
TEST(FitAutoregressive, MatchesAHeldOutHalf) {
  const Series s = synthetic(80.0, 3);
  const auto fit = fit_autoregressive(s.recording());
  EXPECT_LT(std::abs(fit.held_out.variance_error), 0.10);
  EXPECT_LT(fit.held_out.spectrum_error, 0.10);
  EXPECT_LT(fit.held_out.worst_band_error, 0.15);
  RecordProperty("models", static_cast<int>(fit.texture.models.size()));
  RecordProperty("variance_error", std::to_string(fit.held_out.variance_error));
  RecordProperty("spectrum_error", std::to_string(fit.held_out.spectrum_error));
  RecordProperty("worst_band_error", std::to_string(fit.held_out.worst_band_error));
}

TEST(FitAutoregressive, FollowsSpeedAndForce) {
  const Series s = synthetic(80.0, 4);
  const auto fit = fit_autoregressive(s.recording(), {.hold_out_half = false});
  EXPECT_GT(fit.texture.models.size(), 8u);
  for (const auto& [speed, force] : {std::pair{0.04, 0.7}, std::pair{0.08, 1.2}, std::pair{0.05, 1.5}}) {
    const Truth truth(speed, force);
    const double r = truth.pole_radius;
    const double a1 = -2.0 * r * std::cos(truth.pole_rad), a2 = r * r;
    const double expected = truth.sigma * truth.sigma * (1.0 + a2) / ((1.0 - a2) * ((1.0 + a2) * (1.0 + a2) - a1 * a1));
    const auto filter = blended_filter(fit.texture, blend_models(fit.texture, speed, force, 0));
    // A model is the mean of its neighbourhood, and rests on some five seconds.
    EXPECT_NEAR(filter.sigma_mps2, std::sqrt(expected), 0.1 * std::sqrt(expected)) << speed << " " << force;
  }
}

TEST(FitAutoregressive, AnotherTextureIsFoundOut) {
  const Series s = synthetic(20.0, 5);
  Series louder = synthetic(20.0, 6);
  for (double& x : louder.acceleration_mps2) x *= 1.5;
  const auto fit = fit_autoregressive(s.recording(), {.hold_out_half = false});
  EXPECT_NEAR(measure_series_error(fit.texture, louder.recording()).variance_error, 1.0 / 2.25 - 1.0, 0.08);
}

TEST(FitAutoregressive, SameInputSameTexture) {
  const Series s = synthetic(10.0, 7);
  const auto a = fit_autoregressive(s.recording());
  const auto b = fit_autoregressive(s.recording());
  ASSERT_EQ(a.texture.models.size(), b.texture.models.size());
  for (std::size_t i = 0; i < a.texture.models.size(); ++i) {
    EXPECT_EQ(a.texture.models[i].ar_lsf_rad, b.texture.models[i].ar_lsf_rad);
    EXPECT_EQ(a.texture.models[i].variance, b.texture.models[i].variance);
  }
  EXPECT_EQ(a.held_out.spectrum_error, b.held_out.spectrum_error);
}

TEST(FitAutoregressive, RefusesWhatIsNoRecording) {
  Series s = synthetic(1.0, 7);
  s.force_N.pop_back();
  EXPECT_THAT([&] { fit_autoregressive(s.recording()); }, ThrowsMessage<Error>(HasSubstr("999 forces")));
  s = synthetic(1.0, 7);
  s.acceleration_mps2[6] = std::nan("");
  EXPECT_THAT([&] { fit_autoregressive(s.recording()); }, ThrowsMessage<Error>(HasSubstr("sample 7")));
  s = synthetic(1.0, 7);
  for (double& v : s.speed_mps) v = 0.0;
  EXPECT_THAT([&] { fit_autoregressive(s.recording()); }, ThrowsMessage<Error>(HasSubstr("0 windows")));
  EXPECT_THAT([&] { fit_autoregressive(s.recording(), {.max_order = 40}); }, ThrowsMessage<Error>(HasSubstr("40")));
}

TEST(FitAutoregressive, SilenceIsATextureOfNothing) {
  Series s = synthetic(2.0, 7);
  for (double& x : s.acceleration_mps2) x = 0.0;
  const auto fit = fit_autoregressive(s.recording());
  EXPECT_EQ(fit.texture.models[0].variance, 0.0);
  EXPECT_EQ(fit.held_out.variance_error, 0.0);
}

}  // namespace
}  // namespace asperity
