#include "../coverage/pitch_by_chance.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include <vector>

#include "../coverage/find_unknown_pitch.h"
#include "asperity/base/random.h"

namespace bench {
namespace {

constexpr double kSpacing_m = 50e-6;
constexpr std::size_t kPoints = 1600;  // 80 mm

// White heights and noise of a hundredth of their power.
std::vector<double> draw_white(asperity::Random& random, double sigma) {
  std::vector<double> out(kPoints);
  for (double& h : out) h = sigma * random.normal();
  return out;
}

// A surface that is random has no pitch, however often its heights are measured again. The pitch that every twin of the
// noise has is of the surface's own highest ordinate.
TEST(PitchByChance, ARandomSurfaceHasTheSamePitchInAllTwinsAndIsNotPeriodic) {
  int in_all_twins = 0, periodic = 0;
  constexpr int kSurfaces = 100;
  for (std::uint64_t seed = 1; seed <= kSurfaces; ++seed) {
    asperity::Random random(seed);
    const std::vector<double> surface = draw_white(random, 1e-5);
    bool same = true, stands_out = true;
    double first_m = 0.0;
    for (int twin = 0; twin < 4; ++twin) {
      const std::vector<double> noise = draw_white(random, 1e-6);
      std::vector<double> heights = surface;
      for (std::size_t i = 0; i < kPoints; ++i) heights[i] += noise[i];
      const double pitch_m = find_unknown_pitch_m(heights, noise, kSpacing_m);
      if (twin == 0) first_m = pitch_m;
      same = same && std::abs(pitch_m / first_m - 1.0) < 0.1;
      stands_out = stands_out && exceeds_random_surface(heights, kSpacing_m, pitch_m);
    }
    in_all_twins += same ? 1 : 0;
    periodic += same && stands_out ? 1 : 0;
  }
  EXPECT_GT(in_all_twins, kSurfaces / 2);
  EXPECT_LE(periodic, 4);  // 1 % of 100; more than 4 has a probability of 0.3 %
}

// A sine of 40 periods whose ordinate is 120 times the density of white noise: n a²/(4 σ²) of n points. The Hann window
// leaves two thirds of that, 80. 32 are needed (½ % of 1,032 frequencies, v = 0.11); ordinate and density scatter by 16
// and 33 %: 2.5 σ, one of 150 waves is missed.
TEST(PitchByChance, AWaveInNoiseIsPeriodic) {
  int periodic = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    asperity::Random random(seed);
    std::vector<double> heights = draw_white(random, 1e-5);
    const double amplitude = 1e-5 * std::sqrt(4.0 * 120.0 / static_cast<double>(kPoints));
    for (std::size_t i = 0; i < kPoints; ++i)
      heights[i] += amplitude * std::sin(2.0 * std::numbers::pi * 40.0 * static_cast<double>(i) / kPoints);
    periodic += exceeds_random_surface(heights, kSpacing_m, 2e-3) ? 1 : 0;
  }
  EXPECT_GE(periodic, 19);
}

}  // namespace
}  // namespace bench
