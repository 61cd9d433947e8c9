#include "../src/relief_level.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"

namespace asperity::registration {
namespace {

constexpr double kWindow_m = 5e-3;
constexpr double kPeriod_m = 2.54e-3;
constexpr double kStep_m = 0.1e-3;

struct Relief {
  std::vector<double> d_m, u_m;
};

// 80 mm over a mesh from which the path drifts by 0.2 mm; `relief` is its height at a place.
template <class Height>
Relief over_drift(Height relief) {
  Relief out;
  for (double u_m = 0.0; u_m < 80e-3; u_m += kStep_m) {
    out.u_m.push_back(u_m);
    out.d_m.push_back(0.2e-3 * std::sin(2.0 * std::numbers::pi * u_m / 60e-3) + relief(u_m));
  }
  return out;
}

// Holes of 1 mm depth, half a period wide, with 5 µm of roughness everywhere: their mean is half their depth under the
// face.
double board(double u_m, double depth_m, Random& random) {
  const bool in_hole = std::fmod(u_m, kPeriod_m) < 0.5 * kPeriod_m;
  return (in_hole ? -depth_m : 0.0) + 5e-6 * random.normal();
}

TEST(ReliefLevel, OfABoardWithHolesIsHalfTheirDepthUnderItsFace) {
  Random random(1);
  const Relief relief = over_drift([&](double u_m) { return board(u_m, 1e-3, random); });
  const ReliefLevel level = measure_relief_level(relief.d_m, relief.u_m, kWindow_m);
  EXPECT_NEAR(level.mean_m, -0.5e-3, 0.05e-3);  // windows have two periods, not whole ones
  EXPECT_NEAR(level.sigma_m, 0.5 * std::abs(level.mean_m), 1e-9);
}

TEST(ReliefLevel, OfDotsIsAboveTheFaceBetweenThem) {
  Random random(1);
  const Relief relief = over_drift([&](double u_m) {
    const double across = std::fmod(u_m, kPeriod_m) / (0.4 * kPeriod_m);  // 0 to 1 over a dot
    return (across < 1.0 ? 1e-3 * std::sin(std::numbers::pi * across) : 0.0) + 5e-6 * random.normal();
  });
  const ReliefLevel level = measure_relief_level(relief.d_m, relief.u_m, kWindow_m);
  EXPECT_NEAR(level.mean_m, 0.4 * 1e-3 * 2.0 / std::numbers::pi, 0.05e-3);
}

TEST(ReliefLevel, OfWhatHasNoFaceIsNotKnownBetterThanItsRms) {
  Random random(7);
  const Relief rough = over_drift([&](double) { return 30e-6 * random.normal(); });
  const ReliefLevel level = measure_relief_level(rough.d_m, rough.u_m, kWindow_m);
  EXPECT_EQ(level.mean_m, 0.0);
  EXPECT_NEAR(level.sigma_m, 30e-6, 2e-6);

  const Relief sine = over_drift([](double u_m) { return 50e-6 * std::sin(2.0 * std::numbers::pi * u_m / kPeriod_m); });
  const ReliefLevel of_sine = measure_relief_level(sine.d_m, sine.u_m, kWindow_m);
  EXPECT_EQ(of_sine.mean_m, 0.0);
  EXPECT_NEAR(of_sine.sigma_m, 50e-6 / std::numbers::sqrt2, 5e-6);
}

TEST(ReliefLevel, OfAFewHeightsIsTheirRms) {
  const std::vector<double> d_m{1e-5, -1e-5, 1e-5, -1e-5}, u_m{0.0, 1e-4, 2e-4, 3e-4};
  const ReliefLevel level = measure_relief_level(d_m, u_m, kWindow_m);
  EXPECT_EQ(level.mean_m, 0.0);
  EXPECT_NEAR(level.sigma_m, 1e-5, 1e-12);
  EXPECT_EQ(measure_relief_level({}, {}, kWindow_m).sigma_m, 0.0);
}

}  // namespace
}  // namespace asperity::registration
