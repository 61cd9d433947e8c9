#include "../src/relief_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "asperity/base/random.h"

namespace asperity::registration {
namespace {

constexpr double kShortest_m = 2e-3, kSpacing_m = 0.25e-3, kRadius_m = 35e-3;

// A path over a ball, with a relief as high as `height_m` says along it.
ReliefScale over_ball(const std::function<double(double)>& height_m, double length_m = 100e-3) {
  std::vector<Eigen::Vector3d> x_m;
  std::vector<double> s_m;
  for (int i = 0; i < static_cast<int>(std::lround(length_m / kSpacing_m)); ++i) {
    const double s = kSpacing_m * i, r_m = kRadius_m + height_m(s), angle = s / kRadius_m;
    x_m.emplace_back(r_m * std::cos(angle), r_m * std::sin(angle), 0.0);
    s_m.push_back(s);
  }
  return measure_relief(x_m, s_m, kShortest_m);
}

TEST(ReliefScale, ABlockIsAsLongAsAPeriodOfTheRelief) {
  for (const double period_m : {2.6e-3, 3.3e-3, 4.2e-3, 4.7e-3}) {
    const auto hole = [&](double s) { return -1e-3 * std::abs(std::remainder(s, period_m)) / period_m; };
    const ReliefScale relief = over_ball(hole);
    EXPECT_NEAR(relief.block_m, period_m, kSpacing_m) << period_m;
    // Of a triangular wave of 0.5 mm: 0.5/√12.
    EXPECT_NEAR(relief.rms_m, 0.5e-3 / std::sqrt(12.0), 0.03e-3) << period_m;
  }
}

TEST(ReliefScale, ItIsTheShortestForAReliefOfNoise) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    double before_m = 0.0;
    const auto noise = [&](double) { return before_m = 0.7 * before_m + 30e-6 * random.normal(); };
    EXPECT_EQ(over_ball(noise).block_m, kShortest_m) << seed;
  }
}

// Of few blocks the means are alike by chance. From the length on at which a period is looked for, 20 times the
// shortest block, chance finds one on at most 2 of 100 paths; shorter ones have none.
TEST(ReliefScale, ShortPathsOfNoiseHaveNoPeriod) {
  for (const double length_m : {36e-3, 40e-3, 45e-3, 51e-3, 60e-3}) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      Random random(1000 + seed);
      double before_m = 0.0;
      const auto noise = [&](double) { return before_m = 0.7 * before_m + 30e-6 * random.normal(); };
      found += over_ball(noise, length_m).block_m == kShortest_m ? 0 : 1;
    }
    EXPECT_LE(found, length_m < 40e-3 ? 0 : 6) << length_m;
  }
}

TEST(ReliefScale, APathOf45MillimetresOverHolesHasTheirPeriod) {
  const auto hole = [&](double s) { return -1e-3 * std::abs(std::remainder(s, 3.3e-3)) / 3.3e-3; };
  EXPECT_NEAR(over_ball(hole, 45e-3).block_m, 3.3e-3, kSpacing_m);
}

TEST(ReliefScale, ABallHasNone) {
  const ReliefScale relief = over_ball([](double) { return 0.0; });
  EXPECT_LT(relief.rms_m, 1e-6);
}

TEST(ReliefScale, ConcludesNothingOfFewPoints) {
  const std::vector<Eigen::Vector3d> x_m{{0, 0, 0}, {1e-3, 0, 0}, {2e-3, 1e-3, 0}, {3e-3, 0, 0}};
  const std::vector<double> s_m{0.0, 1e-3, 2.4e-3, 3.8e-3};
  EXPECT_EQ(measure_relief(x_m, s_m, kShortest_m).block_m, kShortest_m);
  EXPECT_EQ(measure_relief({}, {}, kShortest_m).block_m, kShortest_m);
}

}  // namespace
}  // namespace asperity::registration
