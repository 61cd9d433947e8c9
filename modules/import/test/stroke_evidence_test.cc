// How often a stroke on which nothing is of a surface is taken for a touch, and that one of a surface is.
#include <gtest/gtest.h>

#include <cmath>

#include "air_strokes.h"
#include "asperity/import/measure_stroke_evidence.h"
#include "asperity/testkit/made_stroke.h"
#include "power_chance.h"

namespace asperity {
namespace {

using test::AirNoise;
using test::AirStroke;

// Strokes of `seeds` that are not refused.
int alarms(const AirStroke& made, int seeds) {
  int out = 0;
  for (int k = 0; k < seeds; ++k) {
    Random random(static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(made.noise));
    out += is_trustworthy(judge_stroke(measure_stroke_evidence(air_stroke(made, random)))) ? 1 : 0;
  }
  return out;
}

// 1e-3 of 500 is 0.5; more than 4 have a chance of 2e-4.
constexpr int kSeeds = 500, kMost = 4;

TEST(StrokeEvidence, StationaryNoiseIsSeldomTakenForVibration) {
  for (const AirNoise noise :
       {AirNoise::kWhite, AirNoise::kPink, AirNoise::kBrown, AirNoise::kHum, AirNoise::kBursts}) {
    for (const double still_s : {0.4, 1.0}) {
      for (const bool has_force : {false, true}) {
        EXPECT_LE(alarms({.noise = noise, .still_s = still_s, .moving_s = 1.0, .has_force = has_force}, kSeeds), kMost)
            << test::kAirNoiseNames.at(static_cast<std::size_t>(noise)) << " still for " << still_s << " s, force "
            << has_force;
      }
    }
  }
}

TEST(StrokeEvidence, AnAccelerationAloneIsSeldomTakenForVibration) {
  for (const AirNoise noise : {AirNoise::kWhite, AirNoise::kPink, AirNoise::kBrown, AirNoise::kHum})
    EXPECT_LE(alarms({.noise = noise, .moving_s = 3.0, .has_speed = false, .has_force = false}, kSeeds), kMost)
        << test::kAirNoiseNames.at(static_cast<std::size_t>(noise));
}

// Nothing is quiet: the exponent of the speed decides.
TEST(StrokeEvidence, NoiseSeldomGrowsWithTheSpeed) {
  for (const AirNoise noise : {AirNoise::kWhite, AirNoise::kPink, AirNoise::kBrown})
    EXPECT_LE(alarms({.noise = noise, .still_s = 0.0, .moving_s = 3.0, .has_force = false}, kSeeds), kMost)
        << test::kAirNoiseNames.at(static_cast<std::size_t>(noise));
}

// The tip's inertia exceeds contact_N again and again, the vibration above 40 Hz is there only while the hand moves.
TEST(StrokeEvidence, AProbeThatIsShakenInTheAirHasNotTouched) {
  for (const double tip_kg : {0.01, 0.02, 0.05})
    EXPECT_LE(alarms({.noise = AirNoise::kShaken, .moving_s = 3.0, .tip_kg = tip_kg}, kSeeds), kMost) << tip_kg;
}

TEST(StrokeEvidence, ASurfaceIsFound) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    Stroke stroke = test::air_stroke({.still_s = 0.4, .moving_s = 1.0}, random);
    // Vibration as much as noise, as the square of the speed: 2.5 times the power in the mean is the least.
    for (std::size_t i = 0; i < stroke.size(); ++i)
      stroke.acceleration_mps2[i] += 0.1 * random.normal() * (stroke.speed_mps[i] > 0.0 ? 1.0 : 0.0);
    EXPECT_TRUE(is_trustworthy(judge_stroke(measure_stroke_evidence(stroke)))) << seed;
  }
}

// Closed form: of two groups of normal logarithms Student's t, twice.
TEST(PowerChance, IsStudentsOfTwoGroups) {
  WindowPowers active{10, {}, {}}, quiet{10, {}, {}};
  for (std::size_t i = 0; i < 4; ++i) {  // not side by side
    active.first.push_back(1000 + 30 * i);
    active.power.push_back(std::exp(i % 2 == 0 ? 2.0 : 0.0));
    quiet.first.push_back(30 * i);
    quiet.power.push_back(std::exp(i % 2 == 0 ? 1.0 : -1.0));
  }
  // d = 1, Σ² = 4 + 4, s² = 8/6, t = 1/√(8/6 · 1/2) = 1.224745, 6 degrees: 0.133297 one-sided (tables);
  // of the quiet one s² = 4/3, 3 degrees, the same t: 0.154079.
  EXPECT_NEAR(power_chance(active, quiet), 2.0 * 0.13330, 2e-4);
  EXPECT_EQ(power_chance(quiet, active), 1.0);
}

// A χ² of 2 degrees is an exponential: of n = 100 the mean of the lower ten and of the upper fifty follow from its
// order statistics, E x_(k) = Σ_{j<=k} 1/(n − j + 1).
TEST(PowerChance, OfTheQuietestIsThatOfOrderStatistics) {
  double sum = 0.0, low = 0.0, high = 0.0;
  for (int k = 1; k <= 100; ++k) {
    sum += 1.0 / (101 - k);
    if (k <= 10) low += sum / 10.0;
    if (k > 50) high += sum / 50.0;
  }
  // The mean of the ten scatters by about 1/√10, so its logarithm is within 0.7 of this in 95 %.
  EXPECT_GT(quietest_chance(0.9 * high / low, 100, 10, 2.0), 0.5);
  EXPECT_LT(quietest_chance(2.2 * high / low, 100, 10, 2.0), 0.05);
  EXPECT_LT(quietest_chance(4.0 * high / low, 100, 10, 2.0), 1e-3);
  EXPECT_EQ(quietest_chance(1.0, 100, 10, 2.0), 1.0);
}

TEST(PowerFreedom, OfWhiteNoiseIsTwiceBandwidthTimesTime) {
  Random random(1);
  std::vector<double> x(20000);
  for (double& v : x) v = random.normal();
  EXPECT_NEAR(power_freedom(x, 1000.0, 0.05), 2.0 * 500.0 * 0.05, 2.5);
}

}  // namespace
}  // namespace asperity
