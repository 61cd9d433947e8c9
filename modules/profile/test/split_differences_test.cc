#include "../src/split_differences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {
namespace {

struct Drawn {
  std::vector<double> frequency, difference, noise, surface;
};

// Noise that falls as f⁻⁴ with `scale` of what is stated, and lines `apart_mm` from each other on a surface that falls
// as 1/f; each density a χ² of 24 degrees of freedom.
Drawn draw(double scale, double apart_mm, std::uint64_t seed) {
  Random random(seed, 1);
  Drawn out;
  for (double f = 0.156; f < 4.0; f += 0.078) {
    out.frequency.push_back(f);
    out.noise.push_back(1e-14 * (std::pow(f, -4.0) + 0.1));
    out.surface.push_back(4e-10 / f);
    const double expected = scale * out.noise.back() +
                            out.surface.back() * (1.0 - std::cyl_bessel_j(0.0, 2.0 * std::numbers::pi * f * apart_mm));
    double chi2 = 0.0;
    for (int k = 0; k < 24; ++k) chi2 += std::pow(random.normal(), 2) / 24.0;
    out.difference.push_back(expected * chi2);
  }
  return out;
}

TEST(SplitDifferences, TellsNoiseFromLinesApart) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Drawn noise = draw(0.3, 0.0, seed);
    const SplitDifferences alone = split_differences(noise.frequency, noise.difference, noise.noise, noise.surface);
    // 50 lines of 24 degrees of freedom: 4 %; four of these, and the grid's 3 %.
    EXPECT_NEAR(alone.noise_scale, 0.3, 0.06) << seed;
    EXPECT_LT(alone.lines_m2, 0.1 * alone.noise_m2) << seed;
    const Drawn both = draw(1.0, 0.05, seed);
    const SplitDifferences apart = split_differences(both.frequency, both.difference, both.noise, both.surface);
    EXPECT_NEAR(apart.apart_m, 0.05e-3, 0.011e-3) << seed;
    EXPECT_GT(apart.lines_m2, apart.noise_m2) << seed;
  }
}

}  // namespace
}  // namespace asperity
