#include "asperity/fidelity/signal_agreement.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3, kSegment_m = 12.8e-3;

std::vector<double> sine(double cycles_per_mm, double amplitude, double phase, std::size_t count) {
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i)
    out[i] = amplitude * std::sin(2.0 * std::numbers::pi * cycles_per_mm * 0.025 * static_cast<double>(i) + phase);
  return out;
}

std::vector<BandSignals> all_compared(const CrossSpectra& spectra, double low, double high) {
  std::vector<BandSignals> out = third_octaves(spectra, low, high);
  for (BandSignals& band : out) band.is_compared = true;
  return out;
}

TEST(SignalAgreement, ASineHasItsRmsItsGainAndItsPhase) {
  const std::vector<double> a = sine(1.0, 3.0, 0.2, 3200), b = sine(1.0, 1.5, 0.2 + 0.5, 3200);
  const CrossSpectra spectra = cross_spectra(a, b, kSpacing_m, kSegment_m);
  EXPECT_EQ(spectra.segments(), 11u);
  const SignalAgreement result = agreement_of(spectra, all_compared(spectra, 0.15, 4.0), spectra.segments(), 0.01);
  // A Hann window's lines, three of them, are all in the band; the rest of the window's skirt is below 1e-3.
  EXPECT_NEAR(result.real_rms, 3.0 / std::numbers::sqrt2, 3e-3);
  EXPECT_NEAR(result.other_rms, 1.5 / std::numbers::sqrt2, 2e-3);
  EXPECT_NEAR(result.level_dB, -6.0206, 1e-2);
  EXPECT_NEAR(result.correlation, std::cos(0.5), 1e-3);
}

TEST(SignalAgreement, BandsAreThirdsOfAnOctaveWithoutHoles) {
  const std::vector<double> x = sine(1.0, 1.0, 0.0, 3200);
  const CrossSpectra spectra = cross_spectra(x, x, kSpacing_m, kSegment_m);
  const std::vector<BandSignals> bands = third_octaves(spectra, 0.15, 4.0);
  ASSERT_GT(bands.size(), 8u);
  EXPECT_EQ(bands.front().low_cycles_per_mm, 0.15);
  EXPECT_NEAR(bands.back().high_cycles_per_mm, 4.0, 1e-9);
  for (std::size_t b = 1; b < bands.size(); ++b) {
    EXPECT_EQ(bands[b].low_cycles_per_mm, bands[b - 1].high_cycles_per_mm);
    if (bands[b].low_cycles_per_mm > 1.0 && b + 1 < bands.size()) {
      EXPECT_NEAR(bands[b].high_cycles_per_mm / bands[b].low_cycles_per_mm, std::cbrt(2.0), 0.02);
    }
  }
}

TEST(SignalAgreement, IndependentNoiseRarelyExceedsTheThreshold) {
  // 200 pairs of independent white noise, some 12 bands each, α = 0.05 a pair: 10 expected. 25 is 4.8 standard
  // deviations of a binomial; the window's dependence is allowed for, so few are wrong, and some must be.
  Random random(17);
  int exceeded = 0;
  for (int pair = 0; pair < 200; ++pair) {
    std::vector<double> a(3200), b(3200);
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i] = random.normal();
      b[i] = random.normal();
    }
    const CrossSpectra spectra = cross_spectra(a, b, kSpacing_m, kSegment_m);
    const SignalAgreement result = agreement_of(spectra, all_compared(spectra, 0.15, 4.0), spectra.segments(), 0.05);
    bool any = false;
    for (const BandSignals& band : result.bands) any = any || band.coherence > band.threshold;
    exceeded += any ? 1 : 0;
  }
  EXPECT_LE(exceeded, 25);
}

TEST(SignalAgreement, GapsEmptyTheirSegmentsAndNothingElse) {
  std::vector<double> a = sine(1.0, 1.0, 0.0, 3200);
  const std::vector<double> b = a;
  for (std::size_t i = 1000; i < 1100; ++i) a[i] = std::nan("");
  const CrossSpectra spectra = cross_spectra(a, b, kSpacing_m, kSegment_m);
  EXPECT_EQ(spectra.whole_segments(), 9u);
  const SignalAgreement result = agreement_of(spectra, all_compared(spectra, 0.15, 4.0), spectra.segments(), 0.01);
  EXPECT_NEAR(result.correlation, 1.0, 1e-12);
  EXPECT_NEAR(result.distance_dB, 0.0, 1e-12);
  EXPECT_THROW(cross_spectra(a, std::vector<double>(7), kSpacing_m, kSegment_m), Error);
}

TEST(SignalAgreement, TheScoreHalvesWithSixDecibels) {
  SignalAgreement agreement;
  agreement.correlation = 0.8;
  agreement.distance_dB = 6.0;
  EXPECT_NEAR(agreement_score(agreement, 6.0), 0.4, 1e-15);
  agreement.correlation = -0.8;
  EXPECT_EQ(agreement_score(agreement, 6.0), 0.0);
  EXPECT_TRUE(std::isnan(agreement_score(SignalAgreement{}, 6.0)));
}

}  // namespace
}  // namespace asperity
