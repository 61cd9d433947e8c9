#include "asperity/signal/zero_phase.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> cosine(std::size_t n, double cycles_per_sample) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::cos(2.0 * kPi * cycles_per_sample * static_cast<double>(i));
  return x;
}

// Amplitude and phase over the middle half, which must hold whole periods.
std::complex<double> measure_response(const std::vector<double>& y, double cycles_per_sample) {
  const std::size_t n = y.size() / 2;
  std::complex<double> sum = 0.0;
  for (std::size_t i = n / 2; i < n / 2 + n; ++i) {
    sum += y[i] * std::polar(1.0, -2.0 * kPi * cycles_per_sample * static_cast<double>(i));
  }
  return 2.0 * sum / static_cast<double>(n);
}

TEST(ZeroPhase, CornerRatio) {
  EXPECT_NEAR(zero_phase_corner_ratio(2), 0.802, 5e-4);  // erratum 12
  EXPECT_NEAR(std::pow(zero_phase_corner_ratio(3), 6.0), std::numbers::sqrt2 - 1.0, 1e-14);
}

// Sines through the whole filter: -3 dB at the cut-off, no phase, for every kind and order.
TEST(ZeroPhase, MeasuredGainAtTheCutoffIsMinusThreeDecibels) {
  constexpr std::size_t n = 16000;
  constexpr double kGainTol = 2e-6;  // what is left of the ends' transients
  for (int order = 1; order <= 5; ++order) {
    const double low = 0.01;
    const double high = 0.1;
    const auto at_low = cosine(n, low);
    const auto at_high = cosine(n, high);
    const std::complex<double> gains[] = {measure_response(zero_phase_highpass(at_low, low, 1.0, order), low),
                                          measure_response(zero_phase_lowpass(at_high, high, 1.0, order), high),
                                          measure_response(zero_phase_bandpass(at_low, low, high, 1.0, order), low),
                                          measure_response(zero_phase_bandpass(at_high, low, high, 1.0, order), high)};
    for (const auto& gain : gains) {
      EXPECT_NEAR(gain.real(), std::numbers::sqrt2 / 2, kGainTol) << order;
      EXPECT_NEAR(gain.imag(), 0.0, kGainTol) << order;
    }
  }
}

TEST(ZeroPhase, GainElsewhereIsTheSquareOfOnePass) {
  const auto pass = zero_phase_bandpass_pass(0.02, 0.2, 1.0, 3);
  for (const double f : {0.01, 0.05, 0.125, 0.25, 0.4}) {
    const auto gain = measure_response(zero_phase_bandpass(cosine(16000, f), 0.02, 0.2, 1.0, 3), f);
    EXPECT_NEAR(gain.real(), std::norm(frequency_response(pass, f, 1.0)), 1e-6) << f;
  }
}

// A straight line is continued by its odd reflection, so a high-pass removes it at the ends too.
TEST(ZeroPhase, HighPassRemovesALineAndLowPassKeepsIt) {
  std::vector<double> line(2000);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = 3.0 + 0.01 * static_cast<double>(i);
  const auto high = zero_phase_highpass(line, 0.02, 1.0);
  const auto low = zero_phase_lowpass(line, 0.02, 1.0);
  for (std::size_t i = 0; i < line.size(); ++i) {
    EXPECT_NEAR(high[i], 0.0, 2e-3);  // the transient of the slope, a thousandth of its range at the ends
    EXPECT_NEAR(low[i], line[i], 2e-3);
  }
  for (std::size_t i = 500; i < 1500; ++i) EXPECT_NEAR(high[i], 0.0, 1e-6);
}

TEST(ZeroPhase, ConstantsAreExactAndShortSignalsWork) {
  for (const std::size_t n : {1u, 2u, 3u, 10u}) {
    const std::vector<double> x(n, 2.5);
    for (const double v : zero_phase_lowpass(x, 0.05, 1.0, 4)) EXPECT_NEAR(v, 2.5, 1e-9);
    for (const double v : zero_phase_highpass(x, 0.05, 1.0, 4)) EXPECT_NEAR(v, 0.0, 1e-9);
  }
  EXPECT_TRUE(zero_phase_lowpass({}, 0.05, 1.0).empty());
}

// Filtering the reversed signal gives the reversed result: a property of a filter without phase.
TEST(ZeroPhase, CommutesWithReversalInTheInterior) {
  Random random(3);
  std::vector<double> x(3000);
  for (double& v : x) v = random.normal();
  auto y = zero_phase_bandpass(x, 0.01, 0.2, 1.0, 4);
  std::reverse(x.begin(), x.end());
  const auto z = zero_phase_bandpass(x, 0.01, 0.2, 1.0, 4);
  std::reverse(y.begin(), y.end());
  for (std::size_t i = 1000; i < 2000; ++i) EXPECT_NEAR(y[i], z[i], 1e-4);
}

// The interleaved recursion against the plain difference equation in long double, section by section.
TEST(ZeroPhase, AgreesWithTheDifferenceEquationInExtendedPrecision) {
  Random random(4);
  std::vector<double> x(4000, 0.0);
  for (std::size_t i = 1500; i < 2500; ++i) x[i] = random.normal();
  for (const auto& sections : {butterworth_highpass(5, 0.02, 1.0), butterworth_bandpass(7, 0.02, 0.1, 1.0)}) {
    std::vector<long double> y(x.begin(), x.end());
    for (int pass = 0; pass < 2; ++pass) {
      for (const Biquad& s : sections) {
        long double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
        for (long double& v : y) {
          const long double out = s.b0 * v + s.b1 * x1 + s.b2 * x2 - s.a1 * y1 - s.a2 * y2;
          x2 = x1, x1 = v, y2 = y1, y1 = out, v = out;
        }
      }
      std::reverse(y.begin(), y.end());
    }
    const auto z = zero_phase_filter(x, sections);
    for (std::size_t i = 1000; i < 3000; ++i) EXPECT_NEAR(z[i], static_cast<double>(y[i]), 1e-8);
  }
}

TEST(ZeroPhase, RejectsGaps) {
  const std::vector<double> x{1.0, 2.0, std::numeric_limits<double>::quiet_NaN(), 4.0};
  EXPECT_THROW(zero_phase_highpass(x, 0.1, 1.0), Error);
}

}  // namespace
}  // namespace asperity
