#include "asperity/profile/correlation_under_stretch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kLength_mm = 100.0;
constexpr double kSpacing_mm = 0.1;
constexpr double kLow = 0.3, kHigh = 1.5;  // cycles/mm, with a density that falls as 1/k

// A sum of waves with random phases, read at any position.
struct Waves {
  std::vector<double> k, amplitude, phase;

  explicit Waves(Random& random) {
    constexpr int kWaves = 100;
    for (int i = 0; i < kWaves; ++i) {
      k.push_back(kLow + (kHigh - kLow) * (i + random.uniform()) / kWaves);
      amplitude.push_back(1.0 / std::sqrt(k.back()));
      phase.push_back(2.0 * std::numbers::pi * random.uniform());
    }
  }
  std::vector<double> read(double stretch) const {
    std::vector<double> out;
    const double middle_mm = 0.5 * kLength_mm;
    for (double s = 0.0; s <= kLength_mm; s += kSpacing_mm) {
      double h = 0.0;
      const double at_mm = s + stretch * (s - middle_mm);
      for (std::size_t i = 0; i < k.size(); ++i)
        h += amplitude[i] * std::sin(2.0 * std::numbers::pi * k[i] * at_mm + phase[i]);
      out.push_back(h);
    }
    return out;
  }
};

double best_correlation(const std::vector<double>& a, const std::vector<double>& b, std::ptrdiff_t reach) {
  double best = -1.0;
  for (std::ptrdiff_t shift = -reach; shift <= reach; ++shift) {
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const std::ptrdiff_t j = static_cast<std::ptrdiff_t>(i) + shift;
      if (j < 0 || j >= static_cast<std::ptrdiff_t>(b.size())) continue;
      const double y = b[static_cast<std::size_t>(j)];
      ab += a[i] * y;
      aa += a[i] * a[i];
      bb += y * y;
    }
    best = std::max(best, ab / std::sqrt(aa * bb));
  }
  return best;
}

double stated(double sigma) {
  std::vector<double> k, density;
  for (int i = 0; i <= 400; ++i) {
    k.push_back(kLow + (kHigh - kLow) * i / 400.0);
    density.push_back(1.0 / k.back());
  }
  return correlation_under_stretch(k, density, sigma, kLength_mm);
}

// Drawn errors of the length, each texture aligned by its best shift. The best of many shifts is above the one in the
// middle by up to 0.02; what 40 draws leave to chance is the mean's own standard error.
TEST(CorrelationUnderStretch, IsTheMeanOfSimulatedStretches) {
  for (const double sigma : {0.001, 0.003, 0.006}) {
    constexpr int kDraws = 40;
    Random random(7);
    double sum = 0.0, square = 0.0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const double error = sigma * random.normal();
      const Waves waves(random);
      const double r = best_correlation(waves.read(error), waves.read(0.0), 12);
      sum += r / kDraws;
      square += r * r / kDraws;
    }
    const double chance = std::sqrt((square - sum * sum) / (kDraws - 1));
    EXPECT_GT(sum, stated(sigma) - 3.0 * chance) << sigma;
    EXPECT_LT(sum, stated(sigma) + 0.02 + 3.0 * chance) << sigma;
  }
}

TEST(CorrelationUnderStretch, OfOneWaveHasAClosedForm) {
  // A narrow band about k: a mean of exp(−x²/2) over 0 to πkσL, 2 here; by Simpson's rule with 200 steps.
  const double k = 2.0 / (std::numbers::pi * 0.01 * kLength_mm);
  double integral = 0.0;
  for (int i = 0; i <= 200; ++i) {
    const double weight = i == 0 || i == 200 ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    integral += weight * std::exp(-0.5 * std::pow(2.0 * i / 200.0, 2)) / 600.0;
  }
  const std::vector<double> at{k * (1.0 - 1e-6), k * (1.0 + 1e-6)}, density{1.0, 1.0};
  EXPECT_NEAR(correlation_under_stretch(at, density, 0.01, kLength_mm), integral, 1e-6);
  EXPECT_DOUBLE_EQ(correlation_under_stretch(at, density, 0.0, kLength_mm), 1.0);
  EXPECT_DOUBLE_EQ(correlation_under_stretch({}, {}, 0.01, kLength_mm), 1.0);
}

}  // namespace
}  // namespace asperity
