#include "asperity/profile/measure_spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;

std::vector<double> sine(double cycles_per_mm, double amplitude_m, std::size_t points) {
  std::vector<double> out;
  for (std::size_t k = 0; k < points; ++k) {
    const double s_mm = 1e3 * kSpacing_m * static_cast<double>(k);
    out.push_back(amplitude_m * std::sin(2.0 * std::numbers::pi * cycles_per_mm * s_mm));
  }
  return out;
}

double variance(const PowerSpectrum& spectrum) {
  double sum = 0.0;
  for (const double density : spectrum.density) sum += density * (spectrum.frequency[1] - spectrum.frequency[0]);
  return sum;
}

TEST(MeasureSpectrum, ASineIsALineOfItsVariance) {
  const PowerSpectrum spectrum = measure_spectrum(sine(0.5, 20e-6, 6000), kSpacing_m);
  const auto peak = std::max_element(spectrum.density.begin(), spectrum.density.end()) - spectrum.density.begin();
  EXPECT_NEAR(spectrum.frequency[static_cast<std::size_t>(peak)], 0.5, 0.5 / 25.6);
  EXPECT_NEAR(variance(spectrum), 0.5 * 20e-6 * 20e-6, 0.01 * 0.5 * 20e-6 * 20e-6);
  EXPECT_NEAR(spectrum.frequency.back(), 20.0, 1e-9);  // cycles/mm at 0.025 mm
}

TEST(MeasureSpectrum, GapsPartTheProfileAndDoNotShowInIt) {
  Random random(4);
  std::vector<double> whole(20000);
  for (double& h : whole) h = 1e-6 * random.normal();
  std::vector<double> gapped = whole;
  for (std::size_t k = 3000; k < 20000; k += 3000)
    std::fill_n(gapped.begin() + static_cast<std::ptrdiff_t>(k), 40, NAN);
  const PowerSpectrum a = measure_spectrum(whole, kSpacing_m), b = measure_spectrum(gapped, kSpacing_m);
  ASSERT_EQ(a.density.size(), b.density.size());
  EXPECT_LT(b.segments, a.segments);
  EXPECT_NEAR(variance(b) / variance(a), 1.0, 0.03);  // some 30 segments of 1024 values of white noise
}

TEST(MeasureSpectrum, WhatIsTooShortHasNone) {
  EXPECT_TRUE(measure_spectrum({}, kSpacing_m).density.empty());
  EXPECT_TRUE(measure_spectrum(std::vector<double>(500, NAN), kSpacing_m).density.empty());
  EXPECT_FALSE(measure_spectrum(sine(2.0, 1e-6, 100), kSpacing_m).density.empty());
  EXPECT_THROW(measure_spectrum(sine(2.0, 1e-6, 100), 0.0), Error);
}

}  // namespace
}  // namespace asperity
