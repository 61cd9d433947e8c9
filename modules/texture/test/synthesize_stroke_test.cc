#include "asperity/texture/synthesize_stroke.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/texture/autoregressive_filter.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

double rms(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double v : x) sum += v * v;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

TEST(SynthesizeStroke, OfASineIsItsSecondDerivative) {
  Texture t;
  t.model = Fourier1d{2.5, {0.0}, {1e-5}, 0.0};
  const StrokeConfig config{.speed_mps = 0.05, .rate_Hz = 8000.0, .duration_s = 0.5, .start_m = 1e-3};
  const auto x = synthesize_stroke(t, config);
  ASSERT_EQ(x.size(), 4000u);
  const double k = 2.0 * std::numbers::pi / 2.5e-3;
  const double step_m = 0.05 / 8000.0;
  // The mean of −A k² v² sin(kx) over one sample's travel: sin(ks/2)/(ks/2) of its value.
  const double averaged = std::sin(0.5 * k * step_m) / (0.5 * k * step_m);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double at_m = 1e-3 + static_cast<double>(i) * step_m;
    ASSERT_NEAR(x[i], -1e-5 * k * k * 0.05 * 0.05 * averaged * std::sin(k * at_m), 1e-8);
  }
}

TEST(SynthesizeStroke, OfAModelIsTheModels) {
  AutoregressiveTexture model;
  model.models.push_back({0.05, 1.0, reflection_to_lsf(std::vector<double>{-0.5, 0.4}), {}, 1.0, 0.3});
  prepare_autoregressive(model, "test");
  Texture t;
  t.model = model;
  const auto x = synthesize_stroke(t, {.rate_Hz = 1000.0, .duration_s = 60.0});
  EXPECT_NEAR(rms(x), model.models[0].sigma_mps2, 0.03 * model.models[0].sigma_mps2);
  // Played faster, the same vibration: what it is at 1 kHz, it is at 4 kHz.
  EXPECT_NEAR(rms(synthesize_stroke(t, {.rate_Hz = 4000.0, .duration_s = 60.0})), rms(x), 0.05 * rms(x));

  t.model = DecayingSinusoids{100.0, 0.0, 50.0, 1000.0, 0.05, 0.0, 0.0};
  const auto tap = synthesize_stroke(t, {.speed_mps = 0.1, .rate_Hz = 4000.0, .duration_s = 0.1});
  EXPECT_NEAR(tap[3], 10.0 * std::exp(-50.0 * 1e-3) * std::sin(1.0), 1e-9);

  t.model = StochasticTexture{.sigma_m = 1e-6, .stiffness_N_per_m = 500.0, .mass_kg = 0.05};
  EXPECT_NEAR(rms(synthesize_stroke(t, {.rate_Hz = 1000.0, .duration_s = 60.0})), 1e-6 * 500.0 / 0.05, 2e-4);
}

TEST(SynthesizeStroke, EndsWhenItIsCancelled) {
  AutoregressiveTexture series;
  series.models.push_back({0.05, 1.0, reflection_to_lsf(std::vector<double>{-0.5, 0.4}), {}, 1.0, 0.3});
  prepare_autoregressive(series, "test");
  for (const TextureModel& model :
       {TextureModel(Fourier1d{2.5, {0.0}, {1e-5}, 0.0}), TextureModel(StochasticTexture{.sigma_m = 1e-6}),
        TextureModel(DecayingSinusoids{100.0, 0.0, 50.0, 1000.0, 0.05, 0.0, 0.0}), TextureModel(series)}) {
    Texture t;
    t.model = model;
    EXPECT_THROW(synthesize_stroke(t, {.duration_s = 1.0}, {{}, [] { return true; }}), Cancelled);
  }
}

TEST(SynthesizeStroke, SameSeedSameSamples) {
  Texture t;
  t.model = StochasticTexture{.sigma_m = 1e-6};
  EXPECT_EQ(synthesize_stroke(t, {.seed = 4}), synthesize_stroke(t, {.seed = 4}));
  EXPECT_NE(synthesize_stroke(t, {.seed = 4}), synthesize_stroke(t, {.seed = 5}));
}

TEST(SynthesizeStroke, RefusesAConfigOutOfRange) {
  Texture t;
  t.model = StochasticTexture{.sigma_m = 1e-6};
  EXPECT_THAT([&] { synthesize_stroke(t, {.rate_Hz = 0.0}); }, ThrowsMessage<Error>(HasSubstr("rate_Hz 0")));
  EXPECT_THAT([&] { synthesize_stroke(t, {.speed_mps = std::nan("")}); }, ThrowsMessage<Error>(HasSubstr("speed_mps")));
  EXPECT_THAT([&] { synthesize_stroke(t, {.rate_Hz = 1e6, .duration_s = 3600.0}); },
              ThrowsMessage<Error>(HasSubstr("samples")));
}

}  // namespace
}  // namespace asperity
