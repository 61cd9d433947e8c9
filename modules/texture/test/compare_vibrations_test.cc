#include "asperity/texture/compare_vibrations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr double kRate_Hz = 2000.0;

// Pieces of 0.25 s: a sine of 100 Hz in white noise.
ComparedVibration vibration(double amplitude, double noise, std::size_t pieces, std::uint32_t seed,
                            std::size_t noise_pieces = 0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  ComparedVibration out;
  out.rate_Hz = kRate_Hz;
  const auto piece = [&](double a) {
    std::vector<double> x(500);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = a * std::sin(2.0 * std::numbers::pi * 100.0 * static_cast<double>(i) / kRate_Hz) + noise * normal(random);
    return x;
  };
  for (std::size_t i = 0; i < pieces; ++i) out.pieces_mps2.push_back(piece(amplitude));
  for (std::size_t i = 0; i < noise_pieces; ++i) out.noise_mps2.push_back(piece(0.0));
  return out;
}

TEST(CompareVibrations, HasTheRatioOfKnownAmplitudes) {
  const VibrationComparison c = compare_vibrations(vibration(1.0, 0.0, 400, 1), vibration(1.5, 0.0, 400, 2));
  EXPECT_EQ(c.verdict, VibrationVerdict::kNoticeable);
  EXPECT_NEAR(c.a_mps2, std::sqrt(0.5), 1e-3);
  ASSERT_EQ(c.bands[2].low_Hz, 80.0);
  EXPECT_NEAR(c.bands[2].percent, 50.0, 1e-6);
  EXPECT_FALSE(c.bands.back().is_compared);
  EXPECT_EQ(compare_vibrations(vibration(1.0, 0.0, 1, 1), vibration(1.0, 0.0, 1, 1)).verdict,
            VibrationVerdict::kUndetermined);  // one piece shows neither
}

TEST(CompareVibrations, IsTheSameOnlyWhereTheNumberOfPiecesShowsIt) {
  // White noise of one variance: an octave from 20 Hz has 5 lines a piece, so 40 pieces leave a standard deviation of
  // 50 √(2/(0.5·40·5)) = 7 %, above what is noticed (3 %); 40,000 pieces leave 0.2 %.
  EXPECT_EQ(compare_vibrations(vibration(0.0, 1.0, 40, 1), vibration(0.0, 1.0, 40, 2)).verdict,
            VibrationVerdict::kUndetermined);
  EXPECT_EQ(compare_vibrations(vibration(0.0, 1.0, 8000, 1), vibration(0.0, 1.0, 8000, 2)).verdict,
            VibrationVerdict::kSame);
}

TEST(CompareVibrations, TakesOffTheNoiseThatIsKnown) {
  // σ = 1 over 1000 Hz is √0.98 in 20–1000 Hz (up to 900: 0.45 of the rate).
  const VibrationComparison c = compare_vibrations(vibration(1.0, 1.0, 2000, 1, 2000), vibration(1.0, 0.0, 2000, 2));
  EXPECT_NEAR(c.a_mps2, std::sqrt(0.5), 0.02);
  EXPECT_NEAR(c.b_mps2, std::sqrt(0.5), 1e-3);
}

// A recording whose noise is not known may have any part of its power from it: it can be shown to be weaker than
// another vibration, never to be the same or stronger.
TEST(CompareVibrations, IsUndeterminedWhereAnUnknownNoiseCouldBeTheDifference) {
  ComparedVibration unknown = vibration(1.0, 0.3, 2000, 1);
  unknown.most_noise_mps2 = std::numeric_limits<double>::infinity();
  const ComparedVibration clean = vibration(1.0, 0.0, 2000, 2), strong = vibration(4.0, 0.0, 2000, 3);
  using Pair = std::pair<const ComparedVibration*, const ComparedVibration*>;
  for (const auto& [a, b] : {Pair(&unknown, &clean), Pair(&clean, &unknown), Pair(&unknown, &unknown)})
    EXPECT_EQ(compare_vibrations(*a, *b).verdict, VibrationVerdict::kUndetermined);
  EXPECT_EQ(compare_vibrations(unknown, strong).verdict, VibrationVerdict::kNoticeable);
  EXPECT_EQ(compare_vibrations(strong, unknown).verdict, VibrationVerdict::kNoticeable);
  // Stated: what is left of the power is at least 0.5 − 0.3² (m/s²)².
  unknown.most_noise_mps2 = 0.3;
  EXPECT_EQ(compare_vibrations(unknown, vibration(0.5, 0.0, 2000, 4)).verdict, VibrationVerdict::kNoticeable);
  const VibrationComparison c = compare_vibrations(clean, unknown);
  ASSERT_EQ(c.bands[2].low_Hz, 80.0);
  EXPECT_NEAR(c.bands[2].most_percent, 100.0 * (1.0 - std::sqrt(0.5 + 0.09 * 0.08 - 0.09) / std::sqrt(0.5)), 0.5);
}

// Noise of five times the vibration's power, of a stated size: what it leaves is uncertain by six times the relative
// error of the whole. Two equal vibrations are noticeably different in at most 5 % of the draws at two standard errors.
TEST(CompareVibrations, StatesTheErrorOfWhatAStatedNoiseLeaves) {
  constexpr double kSignal = 0.2, kNoise = 1.0, kShare = 0.08;  // powers, white; of 80 to 160 Hz in 1000 Hz
  int noticeable = 0;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    ComparedVibration noisy = vibration(0.0, std::sqrt(kSignal + kNoise), 8, seed);
    noisy.most_noise_mps2 = std::sqrt(kNoise * kShare);
    const ComparedVibration clean = vibration(0.0, std::sqrt(kSignal), 200, 1000 + seed);
    const VibrationComparison c = compare_vibrations(noisy, clean, {.low_Hz = 80.0, .high_Hz = 160.0});
    noticeable += c.verdict == VibrationVerdict::kNoticeable ? 1 : 0;
  }
  EXPECT_LE(noticeable, 9);  // 5 expected; ten and more have a probability of 3 %
}

TEST(CompareVibrations, ThrowsForWhatHasNoSpectrum) {
  const ComparedVibration good = vibration(1.0, 0.1, 4, 1);
  EXPECT_THROW(compare_vibrations({{}, {}, kRate_Hz}, good), Error);
  EXPECT_THROW(compare_vibrations({{{1.0, 2.0}}, {}, kRate_Hz}, good), Error);
  EXPECT_THROW(compare_vibrations(good, good, {.low_Hz = 950.0}), Error);
}

}  // namespace
}  // namespace asperity
