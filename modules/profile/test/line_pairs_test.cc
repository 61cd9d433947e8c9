#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "draw_noise.h"
#include "line_search.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;
constexpr std::size_t kPoints = 3200;  // 80 mm
constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kShortest_m = 0.3e-3, kLongest_m = 10e-3;

// White noise of density 1 m²/(cycles/mm) and two waves whose ordinates, without the noise, are so many times that.
std::vector<double> draw_waves(double periods, double first, double second, std::uint64_t seed) {
  Random random(seed);
  const double sigma = std::sqrt(0.5e-3 / kSpacing_m);
  const auto amplitude = [&](double ordinate) { return 2.0 * sigma * std::sqrt(ordinate / kPoints); };
  const double phase = kTwoPi * random.uniform(), other = kTwoPi * random.uniform();
  std::vector<double> out(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double u = kTwoPi * periods * static_cast<double>(i) / kPoints;
    out[i] = amplitude(first) * std::sin(u + phase) + amplitude(second) * std::sin(2.0 * u + other) +
             sigma * random.normal();
  }
  return out;
}

double find_line_m(const std::vector<double>& height_m, const std::vector<double>& frequency,
                   const std::vector<double>& density) {
  const LineSearch search(height_m, kSpacing_m, frequency, density, 1.0, kShortest_m, kLongest_m);
  return search.find_line_m(kShortest_m, kLongest_m);
}

// Two waves of one pattern, neither of which is a line by itself in most draws.
TEST(LinePairs, TwoWavesOfAPatternAreFoundTogether) {
  constexpr double kOrdinate = 25.0;
  for (const double periods : {12.3, 25.7, 40.2}) {
    const double pitch_m = kSpacing_m * kPoints / periods;
    int both = 0, alone = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const double line_m = find_line_m(draw_waves(periods, kOrdinate, kOrdinate, seed), {0.0, 20.0}, {1.0, 1.0});
      both += std::abs(line_m / pitch_m - 1.0) < 0.5 / periods ? 1 : 0;
      alone += find_line_m(draw_waves(periods, kOrdinate, 0.0, seed), {0.0, 20.0}, {1.0, 1.0}) > 0.0 ? 1 : 0;
    }
    EXPECT_GE(both, alone + 8) << periods << " periods: " << both << " and " << alone;
  }
}

// The sum of two independent exponential variables exceeds T with (1 + T) exp(−T): over N frequencies with √(5/2) N
// times about √T more. White noise has a line or a pair in at most 1 %.
TEST(LinePairs, NoiseHasNone) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed)
    found += find_line_m(draw_waves(1.0, 0.0, 0.0, seed), {0.0, 20.0}, {1.0, 1.0}) > 0.0 ? 1 : 0;
  // Of 300 at 1 % more than 8 are found with a probability of 0.4 %.
  EXPECT_LE(found, 8);
}

// A relief of many waves has some at nearly twice the frequency of others: each a line, none of much of the power.
TEST(LinePairs, WavesOfLittlePowerAreNoPattern) {
  for (const double share : {1.0 / 40.0, 1.0 / 8.0}) {
    Random random(4);
    // A band without its middle, so that both waves stand alone in their surroundings.
    std::vector<double> frequency, density;
    for (double f = 0.02; f < 20.0; f *= 1.01) {
      frequency.push_back(f);
      density.push_back(f > 0.2 && f < 0.9 ? 1.0 : 1e-9);
    }
    std::vector<double> x = draw_noise(frequency, density, kPoints, 1e3 * kSpacing_m, random);
    double square = 0.0;
    for (const double h : x) square += h * h / kPoints;
    const double amplitude = std::sqrt(2.0 * share * square);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const double u = kTwoPi * kSpacing_m * static_cast<double>(i) / 0.7e-3;
      x[i] += amplitude * (std::sin(u) + std::sin(2.0 * u + 1.0));
    }
    EXPECT_EQ(find_line_m(x, {}, {}) > 0.0, share > 1.0 / 32.0) << share;
  }
}

// An acceleration's noise falls as f^−4 in heights: (1 − 9/28)^−4 = 4.7 times as much in the middle of the lower side
// as at a wave of 28 periods. What is known of it is no band's edge.
TEST(LineSearch, AWaveBesideSteepNoiseThatIsKnownIsFound) {
  std::vector<double> frequency, density;
  for (double f = 0.05; f < 20.0; f *= 1.01) {
    frequency.push_back(f);
    density.push_back(std::pow(f, -4.0) + 1e-3);
  }
  constexpr double kPeriods = 28.0;
  const double at = kPeriods / (1e3 * kSpacing_m * kPoints);
  // The ordinate is amplitude² L/2 of a length L in mm.
  const double amplitude = std::sqrt(2.0 * 50.0 * std::pow(at, -4.0) / (1e3 * kSpacing_m * kPoints));
  int known = 0, unknown = 0, false_lines = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed, 9);
    std::vector<double> x = draw_noise(frequency, density, kPoints, 1e3 * kSpacing_m, random);
    false_lines += find_line_m(x, frequency, density) > 0.0 ? 1 : 0;
    for (std::size_t i = 0; i < kPoints; ++i)
      x[i] += amplitude * std::sin(kTwoPi * kPeriods * static_cast<double>(i) / kPoints);
    known += find_line_m(x, frequency, density) > 0.0 ? 1 : 0;
    unknown += find_line_m(x, {}, {}) > 0.0 ? 1 : 0;
  }
  EXPECT_GE(known, unknown + 5) << known << " and " << unknown;
  EXPECT_LE(false_lines, 2);
}

}  // namespace
}  // namespace asperity
