// The blocks of the time-series models in a texture file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/texture/autoregressive_filter.h"
#include "asperity/texture/evaluate_autoregressive.h"
#include "asperity/texture/texture_file.h"

namespace asperity {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

AutoregressiveTexture models(int ma_order) {
  Random random(3);
  AutoregressiveTexture t;
  t.rate_Hz = 2000.0;
  for (int i = 0; i < 7; ++i) {
    AutoregressiveModel m;
    m.speed_mps = random.uniform(0.0, 0.2);
    m.force_N = random.uniform(0.0, 3.0);
    std::vector<double> k(5), b(static_cast<std::size_t>(ma_order));
    for (double& v : k) v = random.uniform(-0.8, 0.8);
    for (double& v : b) v = random.uniform(-0.5, 0.5);
    m.ar_lsf_rad = reflection_to_lsf(k);
    if (ma_order > 0) m.ma_lsf_rad = reflection_to_lsf(b);
    m.variance = random.uniform();
    m.gain = random.uniform();
    t.models.push_back(m);
  }
  prepare_autoregressive(t, "test");
  return t;
}

std::string text_of(const TextureModel& model) {
  Texture t;
  t.name = "x";
  t.model = model;
  return format_texture(t);
}

template <class Model>
Model round_trip(const Model& model) {
  const std::string text = text_of(model);
  const Texture back = parse_texture(text, "x.json");
  EXPECT_EQ(format_texture(back), text);
  return std::get<Model>(back.model);
}

// Files of older versions; what is written has the present key alone.
TEST(SeriesFile, CorrelationLengthIsReadByItsFormerName) {
  const std::string text = text_of(StochasticTexture{.sigma_m = 1e-5, .correlation_length_m = 2e-4});
  EXPECT_THAT(text, ::testing::Not(HasSubstr("grain_m")));
  std::string old = text;
  const std::string key = "correlation_length_m";
  old.replace(old.find(key), key.size(), "grain_m");
  const Texture back = parse_texture(old, "old.texture.json");
  EXPECT_EQ(std::get<StochasticTexture>(back.model).correlation_length_m, 2e-4);
  EXPECT_EQ(text_of(std::get<StochasticTexture>(back.model)), text);
}

TEST(SeriesFile, StochasticComesBackAsItWas) {
  const StochasticTexture t{1.0 / 3.0 * 1e-5, 2e-4, 0.3, 2.5, 450.0, 0.04, 0.03, 0.5, 2.0, -0.25, 1e-3};
  const auto back = round_trip(t);
  EXPECT_EQ(back.sigma_m, t.sigma_m);
  EXPECT_EQ(back.force_exponent, -0.25);
  EXPECT_EQ(back.fade_speed_mps, 1e-3);
}

TEST(SeriesFile, DecayingSinusoidsComeBackAsTheyWere) {
  const DecayingSinusoids t{12.0, -0.1, 90.5, 2000.0 / 3.0, 0.06, 0.2, 1e-3};
  const auto back = round_trip(t);
  EXPECT_EQ(back.b_per_kg, -0.1);
  EXPECT_EQ(back.omega_rad_per_s, t.omega_rad_per_s);
  EXPECT_EQ(back.pitch_m, 1e-3);
}

TEST(SeriesFile, AutoregressiveComesBackAsItWas) {
  for (const int ma_order : {0, 3}) {
    const auto t = models(ma_order);
    const auto back = round_trip(t);
    ASSERT_EQ(back.models.size(), t.models.size());
    for (std::size_t i = 0; i < t.models.size(); ++i) {
      EXPECT_EQ(back.models[i].ar_lsf_rad, t.models[i].ar_lsf_rad);
      EXPECT_EQ(back.models[i].ma_lsf_rad, t.models[i].ma_lsf_rad);
      EXPECT_EQ(back.models[i].variance, t.models[i].variance);
      EXPECT_EQ(back.models[i].sigma_mps2, t.models[i].sigma_mps2);
    }
    EXPECT_EQ(back.triangles, t.triangles);
    EXPECT_EQ(back.edges, t.edges);
    SeriesState a = start_series(1), b = start_series(1);
    for (int i = 0; i < 50; ++i)
      EXPECT_EQ(next_acceleration_mps2(t, a, 0.1, 1.0, 1e-3), next_acceleration_mps2(back, b, 0.1, 1.0, 1e-3));
  }
}

void expect_error(const TextureModel& model, const std::string& from, const std::string& to, const std::string& place,
                  const std::string& message) {
  std::string text = text_of(model);
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  EXPECT_THAT([&] { parse_texture(text, "x.json"); },
              ThrowsMessage<Error>(AllOf(HasSubstr(place), HasSubstr(message))));
}

TEST(SeriesFile, NamesFileLineAndKeyOfWhatIsWrong) {
  const StochasticTexture s{.sigma_m = 1e-5};
  expect_error(s, "\"sigma_m\"", "\"sigm\"", "x.json:6:", "key 'stochastic.sigma_m': is missing");
  expect_error(s, "1e-05", "-1", "x.json:7:", "key 'stochastic.sigma_m': -1 is outside");
  expect_error(DecayingSinusoids{}, "\"decay_per_s\": 100,", "", "'decaying_sinusoids.decay_per_s'", "is missing");
  const auto t = models(0);
  expect_error(t, "\"gain\": [", "\"gain\": [1, ", "'autoregressive.gain'", "8 numbers where speed_mps has 7");
  expect_error(t, "\"ar_lsf_rad\": [", "\"ar_lsf_rad\": [0.1, ", "'autoregressive.ar_lsf_rad'",
               "36 numbers for 7 models");
  expect_error(t, "\"triangles\": [", "\"triangles\": [1, ", "'autoregressive.triangles'", "are not triangles");
  expect_error(t, "\"triangles\": [", "\"triangles\": [0, 1, 7, ", "'autoregressive'", "a triangle of model 7");
  expect_error(t, "\"triangles\": [", "\"triangles\": [0, 1, 1.5, ", "'autoregressive.triangles[2]'",
               "1.5 is not an index");
  expect_error(t, "\"rate_Hz\": 2000", "\"rate_Hz\": 0", "'autoregressive.rate_Hz'", "0 is outside");
}

TEST(SeriesFile, WritesOnlyWhatCanBeRead) {
  EXPECT_THAT([] { text_of(StochasticTexture{.sigma_m = -1.0}); }, ThrowsMessage<Error>(HasSubstr("'sigma_m' is -1")));
  EXPECT_THAT([] { text_of(AutoregressiveTexture{}); }, ThrowsMessage<Error>(HasSubstr("0 models")));
}

}  // namespace
}  // namespace asperity
