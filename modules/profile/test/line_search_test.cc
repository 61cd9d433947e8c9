#include "line_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "draw_noise.h"
#include "local_density.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;
constexpr std::size_t kPoints = 3200;  // 80 mm
constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kShortest_m = 0.3e-3, kLongest_m = 10e-3;

double exponential(Random& random) { return -std::log(1.0 - random.uniform()); }

// Ordinates of a random process are exponential about its density, here a peak whose logarithm is a parabola. Of
// exp(−ratio · estimate/density), the probability that another one exceeds its estimate `ratio` times, the mean over
// many estimates has to be what the estimate's variance says; the few ordinates make it a little rarer.
TEST(LocalDensity, AnOrdinateExceedsItByChanceAsOftenAsItsVarianceSays) {
  struct Case {
    int nearest, farthest;
    double peak;  // standard deviation in independent frequencies
  };
  for (const Case& one : {Case{2, 16, 1e9}, Case{1, 5, 2.0}, Case{3, 16, 9.0}}) {
    std::vector<double> offset, density;
    for (int j = one.nearest; j <= one.farthest; ++j) {
      for (const int at : {-j, j}) {
        offset.push_back(at);
        density.push_back(3e-9 * std::exp(-0.5 * at * at / (one.peak * one.peak)));
      }
    }
    Random random(5);
    constexpr int kRuns = 4000;
    double variance = 0.0, by_chance = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      std::vector<double> power(offset.size());
      for (std::size_t i = 0; i < power.size(); ++i) power[i] = density[i] * exponential(random);
      const LocalDensity fit = fit_local_density(offset, power);
      ASSERT_GE(fit.used, 6u);
      if (run == 0) variance = fit.variance;
      const double ratio = (std::exp(variance * 7.0) - 1.0) / variance;  // said to be exp(−7)
      by_chance += std::exp(-ratio * fit.density / 3e-9) / kRuns;
    }
    // 4000 estimates give the mean of such a tail to a fifth; the estimate's own bias makes it up to e^0.5 rarer.
    EXPECT_NEAR(-std::log(by_chance), 7.3, 0.5) << one.nearest << " to " << one.farthest;
  }
}

TEST(LocalDensity, LeavesLinesOut) {
  std::vector<double> offset, power;
  Random random(6);
  for (int j = 2; j <= 16; ++j) {
    for (const int at : {-j, j}) {
      offset.push_back(at);
      power.push_back(at == 7 || at == -12 ? 1e4 : exponential(random));
    }
  }
  const LocalDensity fit = fit_local_density(offset, power);
  EXPECT_EQ(fit.used, offset.size() - 2);
  EXPECT_NEAR(std::log(fit.density), 0.0, 3.0 * std::sqrt(fit.variance));
  EXPECT_EQ(fit_local_density(std::vector{-1.0, 1.0}, std::vector{1.0, 1.0}).used, 0u);
}

// Gaussian, of the given density over cycles/mm.
std::vector<double> draw(const std::function<double(double)>& psd, std::size_t points, Random& random) {
  std::vector<double> frequency, density;
  for (double f = 0.02; f < 20.0; f *= 1.01) {
    frequency.push_back(f);
    density.push_back(1e-12 * psd(f));
  }
  return draw_noise(frequency, density, points, 1e3 * kSpacing_m, random);
}

double log_uniform(Random& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

double peak_at(double f, double centre, double width) {
  return std::exp(-0.5 * std::pow((f / centre - 1.0) / width, 2.0));
}

double find_line_m(const std::vector<double>& height_m) {
  return LineSearch(height_m, kSpacing_m, {}, {}, 1.0, kShortest_m, kLongest_m).find_line_m(kShortest_m, kLongest_m);
}

// The stated rate of 1 %, over smooth spectra and peaks of at least a twentieth of their frequency, from 16 periods.
TEST(LineSearch, ARandomSurfaceHasALineInAtMostOneOfAHundred) {
  const std::vector<std::function<std::vector<double>(std::size_t, Random&)>> kinds{
      [](std::size_t n, Random& random) { return draw([](double) { return 1.0; }, n, random); },
      [](std::size_t n, Random& random) {
        const double low = log_uniform(random, 0.1, 1.0), high = log_uniform(random, 1.5, 8.0);
        return draw([&](double f) { return f > low && f < high ? 1.0 : 0.0; }, n, random);
      },
      [](std::size_t n, Random& random) {
        const double slope = random.uniform(1.0, 4.0);
        return draw([&](double f) { return std::pow(f, -slope); }, n, random);
      },
      [](std::size_t n, Random& random) {
        const double centre = log_uniform(random, 0.4, 3.0);
        return draw([&](double f) { return peak_at(f, centre, 0.05); }, n, random);
      },
      [](std::size_t n, Random& random) {
        const double centre = log_uniform(random, 0.4, 3.0), width = log_uniform(random, 0.06, 0.5);
        return draw([&](double f) { return 1e-3 + peak_at(f, centre, width); }, n, random);
      },
      [](std::size_t n, Random& random) {
        std::vector<double> out = draw([](double f) { return std::pow(f, -2.0); }, n, random);
        for (std::size_t i = n / 3; i < n / 3 + n / 10; ++i) out[i] = std::numeric_limits<double>::quiet_NaN();
        return out;
      }};
  int found = 0, profiles = 0;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      Random random(seed, kind);
      const auto points = static_cast<std::size_t>(log_uniform(random, 1600.0, 5600.0));
      found += find_line_m(kinds[kind](points, random)) > 0.0 ? 1 : 0;
      ++profiles;
    }
  }
  // Of 600 at 1 % more than 14 are found with a probability of 0.2 % only.
  EXPECT_LE(found, 14) << "of " << profiles;
}

// An oracle that knows the noise and searches as many frequencies finds ordinates of 20 times the noise in 95 of 100;
// one that has to find the background as well needs up to 6 dB more, where the neighbours are fewest.
TEST(LineSearch, FindsAWaveInNoise) {
  for (const double periods : {10.0, 25.0, 60.0, 200.0}) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Random random(seed);
      const double pitch_m = kSpacing_m * kPoints / periods * random.uniform(0.98, 1.02);
      // The ordinate is amplitude²/4 times the points over the variance.
      const double sigma = std::sqrt(0.25 * static_cast<double>(kPoints) / 80.0);
      std::vector<double> x(kPoints);
      for (std::size_t i = 0; i < kPoints; ++i)
        x[i] = std::sin(kTwoPi * kSpacing_m * static_cast<double>(i) / pitch_m) + sigma * random.normal();
      const std::vector<double> frequency{0.0, 20.0};
      const std::vector<double> density(2, 2e3 * kSpacing_m * sigma * sigma);
      const LineSearch search(x, kSpacing_m, frequency, density, 1.0, kShortest_m, kLongest_m);
      const double line_m = search.find_line_m(kShortest_m, kLongest_m);
      // Within half of an independent frequency.
      found += line_m > 0.0 && std::abs(pitch_m / line_m - 1.0) < 0.5 / periods ? 1 : 0;
    }
    EXPECT_GE(found, 34) << periods << " periods";
  }
}

// Ribs whose pitch is off by 3 % from one to the next, which moves all that follow; gaps; few periods.
TEST(LineSearch, FindsRibsOfUnevenPitchAcrossGaps) {
  for (const double periods : {10.0, 20.0, 60.0, 160.0}) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Random random(seed, 2);
      const double pitch_m = kSpacing_m * kPoints / periods;
      double from_m = -random.uniform() * pitch_m, to_m = from_m + pitch_m;
      std::vector<double> x(kPoints);
      for (std::size_t i = 0; i < kPoints; ++i) {
        const double at_m = kSpacing_m * static_cast<double>(i);
        while (at_m >= to_m) {
          from_m = to_m;
          to_m += pitch_m * (1.0 + 0.03 * random.normal());
        }
        const double u = (at_m - from_m) / (to_m - from_m);
        x[i] = u < 0.45 ? 1.0 - std::cos(kTwoPi * u / 0.45) : 0.0;
        if (i > 2000 && i < 2300) x[i] = std::numeric_limits<double>::quiet_NaN();
      }
      found += find_line_m(x) > 0.0 ? 1 : 0;
    }
    EXPECT_GE(found, 16) << periods << " periods";
  }
}

TEST(LineSearch, AWaveOfLittlePowerIsNoPattern) {
  for (const double amplitude : {0.2, 0.4}) {
    Random random(3);
    std::vector<double> x = draw([](double f) { return f > 0.25 && f < 2.5 ? 1.0 : 0.0; }, kPoints, random);
    double square = 0.0;
    for (const double h : x) square += h * h / kPoints;
    for (std::size_t i = 0; i < kPoints; ++i)
      x[i] += amplitude * std::sqrt(square) * std::sin(kTwoPi * kSpacing_m * static_cast<double>(i) / 0.35e-3);
    // A line either way, beyond the band's edge; an amplitude of a quarter of the RMS decides.
    EXPECT_EQ(find_line_m(x) > 0.0, amplitude > 0.25);
  }
}

TEST(LineSearch, NothingIsNoLine) {
  EXPECT_EQ(find_line_m(std::vector<double>(500, std::numeric_limits<double>::quiet_NaN())), 0.0);
  EXPECT_EQ(find_line_m(std::vector<double>(500, 1e-3)), 0.0);
  EXPECT_EQ(find_line_m({1e-3, 2e-3}), 0.0);
}

// A wild path of 20 m on which 133 heights are present (a gyroscope's zero times 1e6): the search took minutes.
TEST(LineSearch, FewHeightsOfALongPathHaveNoLine) {
  std::vector<double> height_m(800'000, std::numeric_limits<double>::quiet_NaN());
  const auto wave = [](std::size_t i) { return 1e-5 * std::sin(kTwoPi * static_cast<double>(i) * kSpacing_m / 1e-3); };
  for (std::size_t i = 0; i < 133; ++i) height_m[6000 * i] = wave(6000 * i);
  const LineSearch few(height_m, kSpacing_m, {}, {}, 1.0, kShortest_m, kLongest_m);
  EXPECT_EQ(few.find_line_m(kShortest_m, kLongest_m), 0.0);
  EXPECT_FALSE(few.has_pattern(1e-3));
  EXPECT_FALSE(few.has_line(1e-3, 1));

  // As many as there are frequencies, one in eleven, are enough for a line without noise.
  std::vector<double> enough_m(kPoints, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < kPoints; i += 11) enough_m[i] = wave(i);
  EXPECT_NEAR(
      LineSearch(enough_m, kSpacing_m, {}, {}, 1.0, kShortest_m, kLongest_m).find_line_m(kShortest_m, kLongest_m), 1e-3,
      5e-6);
}

// Where the stated noise exceeds the heights at high frequencies, the surface's power came out below 0, and every
// ordinate of a long profile was compared with its neighbours. The bound is 128/(1 − 1/ln 200) waves a height, which
// docs/periodicity-search.md derives.
TEST(LineSearch, OverstatedNoiseDoesNotMakeTheSearchLonger) {
  constexpr double kMostWaves = 158.0;
  const std::vector<double> frequency{0.0, 3.4, 3.5, 20.0};
  for (const std::size_t points : {4000u, 40'000u}) {
    Random random(7);
    std::vector<double> white(points);
    for (double& h : white) h = 1e-6 * random.normal();
    const double density = 2e3 * kSpacing_m * 1e-12;
    const std::vector<double> noise{0.02 * density, 0.02 * density, 10.0 * density, 10.0 * density};
    const auto search = [&](const std::vector<double>& height_m) {
      return LineSearch(height_m, kSpacing_m, frequency, noise, 1.0, kShortest_m, kLongest_m);
    };
    EXPECT_LE(static_cast<double>(search(white).count_candidates()), kMostWaves) << points;
    EXPECT_EQ(search(white).find_line_m(kShortest_m, kLongest_m), 0.0);

    std::vector<double> sparse = white;
    for (std::size_t i = 0; i < points; ++i) {
      if (i % 5 != 0) sparse[i] = std::numeric_limits<double>::quiet_NaN();
    }
    EXPECT_LE(static_cast<double>(search(sparse).count_candidates()), 5.0 * kMostWaves) << points;

    // A line is still one.
    std::vector<double> wavy = white;
    for (std::size_t i = 0; i < points; ++i)
      wavy[i] += 1e-6 * std::sin(kTwoPi * kSpacing_m * static_cast<double>(i) / 1e-3);
    EXPECT_NEAR(search(wavy).find_line_m(kShortest_m, kLongest_m), 1e-3, 5e-6);
  }
}

}  // namespace
}  // namespace asperity
