#include "asperity/texture/convert_rate.h"

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

// Resonances at 90 and 260 Hz, sampled at `rate_Hz`.
AutoregressiveTexture resonant(double rate_Hz) {
  std::vector<double> a(4), k(4);
  const double w1 = 2.0 * std::numbers::pi * 90.0 / rate_Hz, w2 = 2.0 * std::numbers::pi * 260.0 / rate_Hz;
  const double r1 = std::exp(-120.0 / rate_Hz), r2 = std::exp(-200.0 / rate_Hz);
  const double b1 = -2.0 * r1 * std::cos(w1), b2 = r1 * r1, c1 = -2.0 * r2 * std::cos(w2), c2 = r2 * r2;
  a = {b1 + c1, b2 + b1 * c1 + c2, b1 * c2 + b2 * c1, b2 * c2};
  EXPECT_TRUE(ar_to_reflection(a, k));
  AutoregressiveTexture t;
  t.rate_Hz = rate_Hz;
  t.models.push_back({0.1, 1.0, reflection_to_lsf(k), {}, 1.0, 0.7});
  prepare_autoregressive(t, "test");
  return t;
}

double band_power(const AutoregressiveTexture& t, double low_Hz, double high_Hz) {
  const auto& m = t.models[0];
  std::vector<double> a(m.ar_lsf_rad.size());
  lsf_to_ar(m.ar_lsf_rad, a);
  double sum = 0.0;
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i) {
    const double f = low_Hz + (high_Hz - low_Hz) * (i + 0.5) / kSteps;
    sum += power_density(a, {}, m.gain, m.variance, 2.0 * std::numbers::pi * f / t.rate_Hz) * 2.0 / t.rate_Hz *
           (high_Hz - low_Hz) / kSteps;
  }
  return sum;
}

TEST(ConvertRate, TenToOneKilohertzKeepsTheBandsInCommon) {
  const auto fast = resonant(10000.0);
  const auto slow = convert_rate(fast, {.rate_Hz = 1000.0, .order = 16});
  EXPECT_EQ(slow.rate_Hz, 1000.0);
  EXPECT_EQ(slow.models[0].ar_lsf_rad.size(), 16u);
  const double kept = band_power(fast, 0.0, 500.0);
  EXPECT_NEAR(slow.models[0].sigma_mps2 * slow.models[0].sigma_mps2, kept, 1e-3 * kept);
  for (const double low : {0.0, 60.0, 120.0, 200.0, 320.0})
    EXPECT_NEAR(band_power(slow, low, low + 120.0), band_power(fast, low, low + 120.0), 0.05 * kept) << low;
}

TEST(ConvertRate, OneToFourKilohertzKeepsTheVariance) {
  const auto slow = resonant(1000.0);
  const auto fast = convert_rate(slow, {.rate_Hz = 4000.0, .order = 32});
  const double variance = slow.models[0].sigma_mps2 * slow.models[0].sigma_mps2;
  EXPECT_NEAR(fast.models[0].sigma_mps2 * fast.models[0].sigma_mps2, variance, 2e-3 * variance);
  EXPECT_GT(band_power(fast, 0.0, 500.0), 0.95 * variance);
  EXPECT_NEAR(band_power(fast, 60.0, 120.0), band_power(slow, 60.0, 120.0), 0.05 * variance);
}

TEST(ConvertRate, SameRateIsTheSame) {
  const auto t = resonant(1000.0);
  EXPECT_EQ(convert_rate(t, {.rate_Hz = 1000.0}).models[0].ar_lsf_rad, t.models[0].ar_lsf_rad);
}

TEST(ConvertRate, SilenceStaysSilent) {
  auto t = resonant(1000.0);
  t.models[0].variance = 0.0;
  prepare_autoregressive(t, "test");
  EXPECT_EQ(convert_rate(t, {.rate_Hz = 3000.0}).models[0].sigma_mps2, 0.0);
}

TEST(ConvertRate, RefusesARateOutOfRange) {
  EXPECT_THAT([] { convert_rate(resonant(1000.0), {.rate_Hz = 0.0}); }, ThrowsMessage<Error>(HasSubstr("the rate 0")));
  EXPECT_THAT([] { convert_rate({}, {.rate_Hz = 100.0}); }, ThrowsMessage<Error>(HasSubstr("not prepared")));
}

}  // namespace
}  // namespace asperity
