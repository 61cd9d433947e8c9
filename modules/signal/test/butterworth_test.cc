#include "asperity/signal/butterworth.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr double kTol = 1e-12;  // a few roundings of numbers near one
constexpr double kPi = std::numbers::pi;

std::vector<double> polynomial(const std::vector<Biquad>& sections, bool denominator) {
  std::vector<double> out{1.0};
  for (const Biquad& s : sections) {
    const double c[3] = {denominator ? 1.0 : s.b0, denominator ? s.a1 : s.b1, denominator ? s.a2 : s.b2};
    std::vector<double> next(out.size() + 2, 0.0);
    for (std::size_t i = 0; i < out.size(); ++i) {
      for (std::size_t j = 0; j < 3; ++j) next[i + j] += out[i] * c[j];
    }
    out = next;
  }
  return out;
}

// MATLAB's documentation and SciPy print these: butter(2, 0.5), butter(3, 0.5), butter(2, 0.2).
TEST(Butterworth, PublishedCoefficients) {
  const auto second = butterworth_lowpass(2, 0.25, 1.0);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_NEAR(second[0].b0, 0.292893218813452, kTol);
  EXPECT_NEAR(second[0].b1, 0.585786437626905, kTol);
  EXPECT_NEAR(second[0].a1, 0.0, kTol);
  EXPECT_NEAR(second[0].a2, 0.171572875253810, kTol);

  const auto third = butterworth_lowpass(3, 0.25, 1.0);
  const std::vector<double> b{1.0 / 6.0, 0.5, 0.5, 1.0 / 6.0};
  const std::vector<double> a{1.0, 0.0, 1.0 / 3.0, 0.0};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(polynomial(third, false)[i], b[i], kTol);
    EXPECT_NEAR(polynomial(third, true)[i], a[i], kTol);
  }

  const auto low = butterworth_lowpass(2, 0.1, 1.0);
  EXPECT_NEAR(low[0].b0, 0.0674552738890719, kTol);
  EXPECT_NEAR(low[0].a1, -1.1429805025399011, kTol);
  EXPECT_NEAR(low[0].a2, 0.4128015980961885, kTol);
}

// The analytic magnitude of the prewarped filter: 1/sqrt(1 + x^2n).
TEST(Butterworth, MagnitudeIsTheAnalyticOneForAllOrders) {
  const double rate = 40.0;
  const auto warp = [&](double f) { return std::tan(kPi * f / rate); };
  const double low = 0.15;
  const double high = 4.0;
  for (int order = 1; order <= 8; ++order) {
    const auto lp = butterworth_lowpass(order, high, rate);
    const auto hp = butterworth_highpass(order, low, rate);
    const auto bp = butterworth_bandpass(order, low, high, rate);
    EXPECT_EQ(bp.size(), static_cast<std::size_t>(order));
    for (const double f : {0.02, 0.1, 0.15, 0.4, 1.0, 4.0, 9.0, 15.0}) {
      const auto expected = [&](double x) { return 1.0 / std::sqrt(1.0 + std::pow(x * x, order)); };
      const double band = (warp(f) * warp(f) - warp(low) * warp(high)) / ((warp(high) - warp(low)) * warp(f));
      const double relative = 1e-9;  // conditioning of order-8 sections with poles 1e-2 from the circle
      EXPECT_NEAR(std::abs(frequency_response(lp, f, rate)), expected(warp(f) / warp(high)), relative) << order;
      EXPECT_NEAR(std::abs(frequency_response(hp, f, rate)), expected(warp(low) / warp(f)), relative) << order;
      EXPECT_NEAR(std::abs(frequency_response(bp, f, rate)), expected(band), relative) << order << " " << f;
    }
    EXPECT_NEAR(std::abs(frequency_response(lp, high, rate)), std::numbers::sqrt2 / 2, 1e-9);
    EXPECT_NEAR(std::abs(frequency_response(bp, low, rate)), std::numbers::sqrt2 / 2, 1e-9);
  }
}

TEST(Butterworth, AllPolesLieInsideTheUnitCircle) {
  for (int order = 1; order <= 8; ++order) {
    for (const double cutoff : {1e-5, 0.01, 0.3, 0.499}) {
      for (const auto& sections : {butterworth_lowpass(order, cutoff, 1.0), butterworth_highpass(order, cutoff, 1.0),
                                   butterworth_bandpass(order, cutoff / 2, cutoff, 1.0)}) {
        for (const Biquad& s : sections) {
          EXPECT_LT(std::abs(s.a2), 1.0);
          EXPECT_LT(std::abs(s.a1), 1.0 + s.a2 + 1e-15);
        }
      }
    }
  }
}

TEST(Butterworth, RejectsWhatItCannotDesign) {
  EXPECT_THROW(butterworth_lowpass(0, 0.1, 1.0), Error);
  EXPECT_THROW(butterworth_lowpass(9, 0.1, 1.0), Error);
  EXPECT_THROW(butterworth_highpass(2, 0.5, 1.0), Error);
  EXPECT_THROW(butterworth_highpass(2, 0.0, 1.0), Error);
  EXPECT_THROW(butterworth_highpass(2, std::nan(""), 1.0), Error);
  EXPECT_THROW(butterworth_bandpass(2, 0.3, 0.2, 1.0), Error);
  EXPECT_THROW(butterworth_lowpass(2, 0.1, 0.0), Error);
}

}  // namespace
}  // namespace asperity
